# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0

# cmake -DINPUT=FILE -DOUTPUT=FILE -P text_literal.cmake: a text file as a string literal of C++.
file(READ ${INPUT} text)
file(WRITE ${OUTPUT} "R\"~~page~~(${text})~~page~~\"\n")
