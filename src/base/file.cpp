// SPDX-License-Identifier: MIT
#include "base/file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <iterator>
#include <memory>

#include "base/error.h"

namespace izb {
namespace fs = std::filesystem;
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

template <typename Bytes>
Bytes read_file(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) fail("cannot read '{}': it is a directory", path.string());
  // /dev/zero and the like never end.
  if (fs::is_character_file(path, ignored)) fail("cannot read '{}': it is a device", path.string());
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) fail("cannot read '{}': {}", path.string(), std::strerror(errno));

  // Read to the end rather than to the stated size, which pipes do not have.
  const std::uintmax_t size = fs::is_regular_file(path, ignored) ? fs::file_size(path, ignored) : 0;
  Bytes bytes(ignored ? 0 : size, typename Bytes::value_type{});
  size_t used = 0;
  for (;;) {
    if (used == bytes.size()) {
      const int next = std::fgetc(file.get());
      if (next == EOF) break;
      bytes.resize(used + (size_t(1) << 16) + used / 2);
      bytes[used++] = typename Bytes::value_type(next);
    }
    const size_t got = std::fread(bytes.data() + used, 1, bytes.size() - used, file.get());
    used += got;
    if (got == 0) break;
  }
  if (std::ferror(file.get())) fail("cannot read '{}': {}", path.string(), std::strerror(errno));
  bytes.resize(used);
  return bytes;
}

/// A name in the target's folder that no other call and no other running process uses.
fs::path temporary_beside(const fs::path& target) {
  static std::atomic<unsigned> count{0};
  return target.parent_path() / fmt::format(".izb-{}-{}.tmp", getpid(), count++);
}

/// The process that made a temporary of such a name; 0: it is none.
pid_t maker_of(const std::string& name) {
  int process = 0, used = 0;
  unsigned count = 0;
  const bool is_one = std::sscanf(name.c_str(), ".izb-%d-%u.tmp%n", &process, &count, &used) == 2;
  return is_one && used == int(name.size()) && process > 0 ? process : 0;
}

/// One that has ended stays a zombie until somebody waits for it, for ever where nobody does.
bool runs(pid_t process) {
  if (kill(process, 0) != 0) return errno != ESRCH;
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(fmt::format("/proc/{}/stat", process).c_str(), "rb"));
  char text[512] = {};
  if (!file || std::fread(text, 1, sizeof text - 1, file.get()) == 0) return true;
  const char* const after_name = std::strrchr(text, ')');  // the name may hold anything
  return !after_name || std::strncmp(after_name, ") Z", 3) != 0;
}

/// Names that the signal handler may read at any moment: of fixed size and never freed.
struct Slot {
  enum State { free, taken, ready };
  std::atomic<int> state{free};
  char name[4096];
};
Slot slots[16];

/// -1 if all slots are taken or the name is too long: a signal then leaves that file behind.
int take_slot(const fs::path& path) {
  const std::string absolute = fs::absolute(path).string();
  if (absolute.size() >= sizeof Slot::name) return -1;
  for (int i = 0; i < int(std::size(slots)); ++i) {
    int expected = Slot::free;
    if (!slots[i].state.compare_exchange_strong(expected, Slot::taken)) continue;
    std::memcpy(slots[i].name, absolute.c_str(), absolute.size() + 1);
    slots[i].state = Slot::ready;
    return i;
  }
  return -1;
}

void release_slot(int i) {
  if (i >= 0) slots[i].state = Slot::free;
}

/// Only async-signal-safe calls. SA_RESETHAND has restored the default, which ends the process.
void unlink_temporaries(int signal) {
  for (const Slot& slot : slots)
    if (slot.state == Slot::ready) unlink(slot.name);
  raise(signal);
}

}  // namespace

std::vector<std::byte> read_binary_file(const fs::path& path) {
  return read_file<std::vector<std::byte>>(path);
}

std::string read_text_file(const fs::path& path) {
  return read_file<std::string>(path);
}

AtomicFile::AtomicFile(fs::path target) : target_(std::move(target)), final_(target_) {
  std::error_code error;
  if (fs::is_symlink(target_, error)) final_ = fs::weakly_canonical(target_, error);
  const fs::file_status status = fs::status(final_, error);
  if (target_.filename().empty() || fs::is_directory(status)) {
    fail("cannot write '{}': it is a directory", target_.string());
  }

  if (fs::exists(status) && !fs::is_regular_file(status)) {
    file_ = std::fopen(final_.c_str(), "wb");
  } else {
    // A rename would get round the write protection of an old file.
    if (fs::exists(status) && access(final_.c_str(), W_OK) != 0) fail_writing();
    const fs::path folder = final_.has_parent_path() ? final_.parent_path() : fs::path(".");
    if (!fs::exists(folder, error)) {
      fail("cannot write '{}': the folder '{}' does not exist", target_.string(), folder.string());
    }
    temporary_ = temporary_beside(final_);
    signal_slot_ = take_slot(temporary_);  // before there is something to remove
    file_ = std::fopen(temporary_.c_str(), "wbx");
  }
  if (!file_) {
    const int cause = errno;
    release_slot(signal_slot_);
    errno = cause;
    fail_writing();
  }
}

AtomicFile::~AtomicFile() {
  if (file_) std::fclose(file_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
  release_slot(signal_slot_);
}

void AtomicFile::fail_writing() const {
  fail("cannot write '{}': {}", target_.string(), std::strerror(errno));
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  if (bytes.empty()) return;  // their address may be null, which fwrite must not see
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail_writing();
}

void AtomicFile::close() {
  std::FILE* file = std::exchange(file_, nullptr);
  if (file && std::fclose(file) != 0) fail_writing();
}

void AtomicFile::commit() {
  close();
  if (temporary_.empty()) return;
  if (std::rename(temporary_.c_str(), final_.c_str()) != 0) fail_writing();
  temporary_.clear();
  release_slot(std::exchange(signal_slot_, -1));
}

void remove_temporaries_on_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_IGN) continue;  // nohup, or a shell's background job
    action.sa_handler = unlink_temporaries;
    action.sa_flags = int(SA_RESETHAND);
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
}

void remove_stale_temporaries(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const pid_t maker = maker_of(at->path().filename().string());
    if (maker != 0 && !runs(maker)) unlink(at->path().c_str());
  }
}

void write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

void write_file_atomically(const fs::path& path, std::string_view text) {
  write_file_atomically(path, std::as_bytes(std::span(text)));
}

}  // namespace izb
