// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/plugin_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>
#include <type_traits>

#include "core/files/descriptor.h"
#include "harness/run/system_failure.h"
#include "harness/systems/host/plugin_messages.h"
#include "harness/systems/process_group.h"

namespace vinebench::harness {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kHostName = "vinebench_plugin_host";
constexpr int kLookAtLimits = 20;  // ms
constexpr std::chrono::seconds kAfterStop{1};
constexpr std::chrono::seconds kToEnd{5};
constexpr std::size_t kImageAlignment = 64;  // bytes

/// Memory for the largest image of each camera. The other process cannot change its size.
class SharedImages {
 public:
  explicit SharedImages(const vinebench_setup& setup) {
    for (std::size_t i = 0; i < setup.camera_count; ++i) {
      const vinebench_camera& camera = setup.cameras[i];
      offsets_.push_back(size_);
      size_ += 3 * static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
      size_ = (size_ + kImageAlignment - 1) / kImageAlignment * kImageAlignment;
    }
    offsets_.push_back(size_);
    file_ = Descriptor(memfd_create("vinebench images", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    const bool made =
        file_.number() >= 0 && ftruncate(file_.number(), static_cast<off_t>(size_)) == 0 &&
        fcntl(file_.number(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) == 0;
    if (!made) fail("memory for images: {}", std::strerror(errno));
    if (size_ == 0) return;
    void* place = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED, file_.number(), 0);
    if (place == MAP_FAILED) fail("memory for images: {}", std::strerror(errno));
    data_ = static_cast<std::uint8_t*>(place);
  }
  ~SharedImages() {
    if (data_ != nullptr) munmap(data_, size_);
  }
  SharedImages(const SharedImages&) = delete;
  SharedImages& operator=(const SharedImages&) = delete;

  int file() const { return file_.number(); }

  std::vector<SharedImage> copy(const vinebench_frame& frame) {
    std::vector<SharedImage> images;
    for (std::size_t i = 0; i + 1 < offsets_.size(); ++i) {
      images.push_back(copy_image(frame.images[i], i));
    }
    return images;
  }

 private:
  SharedImage copy_image(const vinebench_image& image, std::size_t camera) {
    if (image.data == nullptr) return {-1, 0, 0, image.channels};
    const std::size_t row =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
    const auto rows = static_cast<std::size_t>(image.height);
    const std::size_t offset = offsets_[camera];
    if (rows * row > offsets_[camera + 1] - offset) {
      fail("image of camera {}: {} x {} px with {} channels is larger than the rig says", camera,
           image.width, image.height, image.channels);
    }
    for (std::size_t y = 0; y < rows; ++y) {
      std::memcpy(data_ + offset + y * row, image.data + y * image.stride, row);
    }
    return {static_cast<std::int64_t>(offset), image.width, image.height, image.channels};
  }

  std::vector<std::size_t> offsets_;  ///< of each camera, and of the end
  std::size_t size_ = 0;
  Descriptor file_;
  std::uint8_t* data_ = nullptr;
};

class PluginProcess : public PluginLink {
 public:
  PluginProcess(const std::filesystem::path& host, const PluginSlamConfig& config,
                const vinebench_setup& setup, std::function<bool()> stopped)
      : config_(config),
        file_(std::filesystem::absolute(config.library).string()),
        stopped_(std::move(stopped)),
        images_(setup),
        cameras_(setup.camera_count) {
    start(host);
    MessageWriter question;
    question.add_text(file_);
    add_setup(question, setup);
    name_ = ask({MessageKind::kCreate, question.content()}, MessageKind::kCreated, "create",
                [](MessageReader& answer) { return answer.read_text(); });
  }

  const std::string& name() const override { return name_; }

  PluginEstimate process(const vinebench_frame& frame) override {
    MessageWriter question;
    add_frame(question, frame, images_.copy(frame));
    return ask({MessageKind::kProcess, question.content()}, MessageKind::kEstimate, "process",
               [&](MessageReader& answer) { return read_estimate(answer, cameras_); });
  }

  /// Waits for the process too, so that its time is known as that of the run.
  PluginSummary finish() override {
    PluginSummary summary =
        ask({MessageKind::kFinish, ""}, MessageKind::kSummary, "finish", read_summary);
    socket_.close();
    if (!process_->wait(kToEnd)) process_->kill();
    return summary;
  }

 private:
  void start(const std::filesystem::path& host) {
    int ends[2] = {-1, -1};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
      fail("{}: no socket: {}", file_, std::strerror(errno));
    }
    socket_ = Descriptor(ends[0]);
    const Descriptor other(ends[1]);
    process_.emplace(ProcessStart{.file = host,
                                  .arguments = {std::to_string(getpid())},
                                  .descriptors = {other.number(), images_.file()}});
  }

  template <class Read>
  std::invoke_result_t<Read, MessageReader&> ask(const Message& question, MessageKind expected,
                                                 const char* function, const Read& read) {
    const std::optional<Message> answer = exchange(question, expected, function);
    if (!answer) fail_as_ended(function);
    MessageReader reader(answer->content);
    try {
      if (answer->kind == expected) return read(reader);
      const std::string text = reader.read_text();
      if (answer->kind == MessageKind::kRefused) fail("{}", text);
      fail_system("{}", text);
    } catch (const SystemFailure&) {
      throw;
    } catch (const Error& error) {
      if (answer->kind == MessageKind::kRefused) throw;
      fail_system("{}: {}: answered what cannot be read: {}", file_, function, error.what());
    }
  }

  /// Nothing if the process has ended.
  std::optional<Message> exchange(const Message& question, MessageKind expected,
                                  const char* function) {
    const bool of_a_frame = expected == MessageKind::kEstimate;
    const double seconds = of_a_frame ? config_.frame_timeout : config_.timeout;
    const Clock::time_point start = Clock::now();
    std::optional<Clock::time_point> stop;
    const auto wait = [&](int socket, short events) {
      for (;;) {
        pollfd entry{socket, events, 0};
        if (poll(&entry, 1, kLookAtLimits) > 0) return;
        const Clock::time_point now = Clock::now();
        if (!stop && stopped_ && stopped_()) stop = now + kAfterStop;
        if (stop && now >= *stop) fail_killed(function, "was stopped");
        if (std::chrono::duration<double>(now - start).count() > seconds) {
          fail_killed(function, fmt::format("took more than {} s", seconds));
        }
        check_memory(function);
      }
    };
    check_memory(function);
    try {
      send_message(socket_.number(), question.kind, question.content, wait);
      return receive_message(socket_.number(), wait);
    } catch (const SystemFailure&) {
      throw;
    } catch (const Error& error) {
      if (process_->wait(kToEnd)) return std::nullopt;
      fail_killed(function, error.what());
    }
  }

  void check_memory(const char* function) {
    if (process_->exceeds_memory(config_.memory_mib)) {
      fail_killed(function, fmt::format("used more than {} MiB of memory", config_.memory_mib));
    }
  }

  [[noreturn]] void fail_killed(const char* function, const std::string& why) {
    process_->kill();
    fail_system("{}: {}: {}", file_, function, why);
  }

  [[noreturn]] void fail_as_ended(const char* function) {
    if (!process_->wait(kToEnd)) fail_killed(function, "closed the connection");
    const std::string how = process_->how_it_ended();
    fail_system("{}: {}: its process ended: {}", file_, function, how);
  }

  PluginSlamConfig config_;
  std::string file_;
  std::function<bool()> stopped_;
  SharedImages images_;
  std::size_t cameras_;
  std::string name_;
  std::optional<ProcessGroup> process_;
  Descriptor socket_;
};

}  // namespace

std::filesystem::path find_plugin_host(const std::filesystem::path& program) {
  const std::filesystem::path folder = program.parent_path();
  std::error_code ignored;
  for (const std::filesystem::path& place : {folder, folder / "../libexec/vinebench"}) {
    if (std::filesystem::is_regular_file(place / kHostName, ignored)) return place / kHostName;
  }
  return {};
}

std::unique_ptr<PluginLink> start_plugin_process(const std::filesystem::path& host,
                                                 const PluginSlamConfig& config,
                                                 const vinebench_setup& setup,
                                                 std::function<bool()> stopped) {
  return std::make_unique<PluginProcess>(host, config, setup, std::move(stopped));
}

}  // namespace vinebench::harness
