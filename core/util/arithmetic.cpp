// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/arithmetic.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <gnu/libc-version.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <opencv2/core/utility.hpp>

#include "core/util/pin_arithmetic.h"

namespace vinebench {
namespace {

/// The file that the loader finds a symbol in; empty if there is none.
std::string file_of(const char* symbol, void** base = nullptr) {
  void* address = dlsym(RTLD_DEFAULT, symbol);
  Dl_info info{};
  if (address == nullptr || dladdr(address, &info) == 0) return {};
  if (base != nullptr) *base = info.dli_fbase;
  std::error_code error;
  const auto file = std::filesystem::canonical(info.dli_fname, error);
  return (error ? std::filesystem::path(info.dli_fname) : file).filename().string();
}

/// Whether libraries' references to the symbol are resolved to the object that this code is in.
bool is_ours(const char* symbol) {
  if (are_libraries_pinned()) return true;
  void* base = nullptr;
  Dl_info own{};
  return !file_of(symbol, &base).empty() &&
         dladdr(reinterpret_cast<void*>(&processor_text), &own) != 0 && own.dli_fbase == base;
}

/// Whether this BLAS chooses its code by the processor; the reference and ATLAS are built for one.
bool dispatches(const std::string& blas) {
  for (const char* name : {"openblas", "mkl", "blis"}) {
    if (blas.find(name) != std::string::npos) return true;
  }
  return false;
}

std::string features() {
#if defined(__x86_64__)
  std::string text;
  const auto add = [&text](bool has, const char* name) {
    if (has) text += fmt::format(" {}", name);
  };
  add(__builtin_cpu_supports("sse4.1"), "sse4.1");
  add(__builtin_cpu_supports("avx"), "avx");
  add(__builtin_cpu_supports("avx2"), "avx2");
  add(__builtin_cpu_supports("fma"), "fma");
  add(__builtin_cpu_supports("avx512f"), "avx512f");
  return text.empty() ? "sse2" : text.substr(1);
#else
  return "not x86-64";
#endif
}

std::string processor_line(const std::string& key) {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos || colon + 2 > line.size()) continue;
    std::string name = line.substr(0, colon);
    name.erase(name.find_last_not_of(" \t") + 1);
    if (name == key) return line.substr(colon + 2);
  }
  return "?";
}

}  // namespace

NamedValues arithmetic_of_process() {
  const std::string library = fmt::format("glibc {}", gnu_get_libc_version());
  const std::string blas = file_of("dgemm_");
  return {
      {"libm", is_ours("sin") ? fmt::format("vinebench; other functions: {}", library)
                              : fmt::format("{} for {}", library, features())},
      {"opencv", cv::useOptimized() ? fmt::format("{} for {}", cv::getVersionString(), features())
                                    : fmt::format("{} baseline", cv::getVersionString())},
      {"shaders", is_ours("LLVMBuildCall2") ? "unfused" : fmt::format("for {}", features())},
      {"blas", blas.empty()       ? "none"
               : dispatches(blas) ? fmt::format("{} for {}", blas, features())
                                  : blas}};
}

std::string arithmetic_text() {
  std::string text;
  for (const auto& [name, value] : arithmetic_of_process()) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", name, value);
  }
  return text;
}

std::string processor_text() {
  return fmt::format("{} family {} model {}: {}", processor_line("vendor_id"),
                     processor_line("cpu family"), processor_line("model"), features());
}

}  // namespace vinebench
