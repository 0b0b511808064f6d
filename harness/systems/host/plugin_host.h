// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vinebench::harness {

/// The descriptors that a plug-in's process is started with.
inline constexpr int kHostSocket = 3;
inline constexpr int kHostMemory = 4;  ///< of the images

/// Loads a plug-in as the messages on a socket ask, and answers them until the other side closes
/// the socket. `memory` is a file with the images. Throws Error if that cannot be mapped or the
/// other side is gone while it answers.
void serve_plugin(int socket, int memory);

}  // namespace vinebench::harness
