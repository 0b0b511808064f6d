// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace vinebench::harness {

/// SHA-256 of the bytes, 64 hexadecimal digits.
std::string sha256(const std::string& bytes);

/// What may be published of a seed that stays secret: SHA-256 of "<salt>:<sequence>:<seed>". Who is
/// told salt and seed later can see that they were chosen before; without the salt all seeds could
/// be tried.
std::string commitment_of(const std::string& salt, const std::string& sequence, std::int64_t seed);

/// 128 random bits of the system, 32 hexadecimal digits. Throws Error if it has none.
std::string random_salt();

}  // namespace vinebench::harness
