#include "maggic/atomic_folder.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

namespace maggic {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& folder, std::string_view reason) {
  throw std::runtime_error(fmt::format("cannot write folder '{}': {}", folder.string(), reason));
}

void expect_replaceable(const fs::path& target,
                        const std::function<bool(std::string_view)>& is_ours) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(target, error))) return;
  if (!fs::is_directory(target, error)) fail(target, "there is a file of that name");
  for (const fs::directory_entry& entry : fs::directory_iterator(target, error)) {
    const std::string name = entry.path().filename();
    if (is_ours(name)) continue;
    fail(target, fmt::format("it exists and holds '{}', which replacing it would lose", name));
  }
  if (error) fail(target, error.message());
}

}  // namespace

AtomicFolder::AtomicFolder(fs::path target, const std::function<bool(std::string_view)>& is_ours)
    : target_(std::move(target)) {
  // "report/" names the same folder as "report", but has no name beside which to write.
  if (!target_.has_filename()) target_ = target_.parent_path();
  std::error_code error;
  // Behind a link it is the folder itself that is replaced.
  if (fs::is_symlink(target_, error)) target_ = fs::weakly_canonical(target_, error);
  expect_replaceable(target_, is_ours);
  std::string name = target_.string() + ".XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) {
    fail(target_, std::generic_category().message(errno));
  }
  path_ = name;
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::chmod(path_.c_str(), 0777 & ~mask);
}

AtomicFolder::~AtomicFolder() {
  if (path_.empty()) return;
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void AtomicFolder::commit() {
  if (::rename(path_.c_str(), target_.c_str()) == 0) {
    path_.clear();
    return;
  }
  const bool is_taken = errno == ENOTEMPTY || errno == EEXIST;
  if (!is_taken) fail(target_, std::generic_category().message(errno));
  // The two change places in one step; what was there is then removed as if it had never been done.
  if (::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) return;
  // Some file systems cannot do that: for a moment there is nothing in its place.
  const fs::path old = path_.string() + ".old";
  if (::rename(target_.c_str(), old.c_str()) != 0 ||
      ::rename(path_.c_str(), target_.c_str()) != 0) {
    fail(target_, std::generic_category().message(errno));
  }
  path_ = old;
}

}  // namespace maggic
