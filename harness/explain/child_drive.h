// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <functional>
#include <memory>
#include <string>

#include "core/truth/frame_source.h"

namespace vinebench::harness {

/// The frames of a source that lives in a forked process, so that this process stays without
/// OpenGL and further threads and can be forked again. Of the truth, only pose and path come over.
class ChildDrive : public FrameSource {
 public:
  using Make = std::function<std::unique_ptr<FrameSource>()>;

  /// `make` is called in the child. The rig is the nominal one. Requires that this process has one
  /// thread and no GL context.
  ChildDrive(const Make& make, Rig rig);
  ChildDrive(const ChildDrive&) = delete;
  ChildDrive& operator=(const ChildDrive&) = delete;
  ~ChildDrive() override;

  /// Throws the child's Error.
  std::optional<Sample> next() override;
  /// Not known here.
  std::int64_t size() const override { return 0; }
  const Rig& rig() const override { return rig_; }
  const StageTimes& times() const override { return times_; }

 private:
  Rig rig_;
  StageTimes times_;
  pid_t process_ = 0;
  pid_t parent_ = 0;
  int socket_ = -1;
};

/// A sample as the content of a message, and back.
std::string pack_sample(const Sample& sample);
Sample unpack_sample(const std::string& content);

}  // namespace vinebench::harness
