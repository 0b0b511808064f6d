// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/host/plugin_host.h"

#include <sys/mman.h>
#include <sys/stat.h>

#include <cerrno>
#include <memory>

#include "harness/run/system_failure.h"
#include "harness/systems/host/loaded_plugin.h"
#include "harness/systems/host/plugin_messages.h"

namespace vinebench::harness {
namespace {

/// The images, mapped. A plug-in may write on them: each frame replaces all.
class MappedImages {
 public:
  explicit MappedImages(int memory) {
    struct stat status {};
    if (fstat(memory, &status) != 0) fail("images: {}", std::strerror(errno));
    size_ = static_cast<std::size_t>(status.st_size);
    if (size_ == 0) return;
    data_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED, memory, 0);
    if (data_ == MAP_FAILED) fail("images: {}", std::strerror(errno));
  }
  ~MappedImages() {
    if (size_ > 0) munmap(data_, size_);
  }
  MappedImages(const MappedImages&) = delete;
  MappedImages& operator=(const MappedImages&) = delete;
  const std::uint8_t* data() const { return static_cast<const std::uint8_t*>(data_); }

 private:
  void* data_ = nullptr;
  std::size_t size_ = 0;
};

class PluginHost {
 public:
  explicit PluginHost(int memory) : images_(memory) {}

  /// Fills the answer and returns its kind.
  MessageKind answer(const Message& question, MessageWriter& answer) {
    MessageReader reader(question.content);
    switch (question.kind) {
      case MessageKind::kCreate: {
        const std::string file = reader.read_text();
        setup_ = std::make_unique<ReceivedSetup>(reader);
        plugin_ = std::make_unique<LoadedPlugin>(file, setup_->get());
        answer.add_text(plugin_->name());
        return MessageKind::kCreated;
      }
      case MessageKind::kProcess: {
        const PluginFrame frame = read_frame(reader, images_.data());
        add_estimate(answer, plugin_->process(frame.view()));
        return MessageKind::kEstimate;
      }
      case MessageKind::kFinish:
        add_summary(answer, plugin_->finish());
        return MessageKind::kSummary;
      default:
        fail("no question: message of kind {}", static_cast<int>(question.kind));
    }
  }

 private:
  MappedImages images_;
  std::unique_ptr<ReceivedSetup> setup_;
  std::unique_ptr<LoadedPlugin> plugin_;  // last member: it is destroyed first
};

MessageKind answer_or_error(PluginHost& host, const Message& question, MessageWriter& answer) {
  try {
    return host.answer(question, answer);
  } catch (const SystemFailure& failure) {
    answer = {};
    answer.add_text(failure.what());
    return MessageKind::kFailed;
  } catch (const Error& error) {
    answer = {};
    answer.add_text(error.what());
    return MessageKind::kRefused;
  }
}

}  // namespace

void serve_plugin(int socket, int memory) {
  PluginHost host(memory);
  while (const std::optional<Message> question = receive_message(socket, wait_for_ever)) {
    MessageWriter answer;
    const MessageKind kind = answer_or_error(host, *question, answer);
    send_message(socket, kind, answer.content(), wait_for_ever);
  }
}

}  // namespace vinebench::harness
