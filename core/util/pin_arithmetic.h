// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vinebench {

/// For the begin of a program, or of the Python module, before threads and OpenGL: OpenCV computes
/// with its baseline code on every processor, and Mesa keeps compiled shaders apart from those of
/// other programs (core/portable/llvm_symbols.cpp).
void pin_arithmetic();

/// For a shared object whose libraries were loaded such that they find its definitions of
/// elementary functions first, which this code cannot find out (python/vinebench/_load.py):
/// arithmetic_of_process() says so from now on.
void declare_libraries_pinned();
bool are_libraries_pinned();

}  // namespace vinebench
