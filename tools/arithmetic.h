// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vinebench::tools {

/// For the program's begin, before threads and OpenGL: OpenCV computes with its baseline code on
/// every processor, and Mesa keeps compiled shaders apart from those of other programs
/// (core/portable/llvm_symbols.cpp).
void pin_arithmetic();

}  // namespace vinebench::tools
