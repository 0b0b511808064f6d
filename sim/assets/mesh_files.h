// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <assimp/IOSystem.hpp>
#include <list>
#include <string>

namespace vinebench::sim {

/// The files that assimp sees: one mesh, whose content was read and checked before, and the
/// material libraries that it names, each read whole and checked. Throws Error for a library that
/// is no file or no text; one that does not exist is left out.
class MeshFiles : public Assimp::IOSystem {
 public:
  /// `content` outlives this object.
  MeshFiles(std::string name, const std::string& content)
      : name_(std::move(name)), content_(content) {}

  bool Exists(const char* name) const override;
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;

 private:
  std::string name_;
  const std::string& content_;
  std::list<std::string> libraries_;
};

}  // namespace vinebench::sim
