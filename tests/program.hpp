#pragma once
/// Starts programs as a user would, the built `maggic` above all, for tests of the whole.

#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace maggic::testing {

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

struct ProgramResult {
  int exit_code = -1;  ///< -1: ended by a signal.
  std::string out;
  std::string err;
};

/// One running program, its output kept in `folder`. Killed if still running when destroyed.
class Program {
 public:
  /// Starts `maggic`, which lies beside the test program, in the build tree as in every preset.
  Program(const std::filesystem::path& folder, std::vector<std::string> arguments)
      : Program(folder, std::filesystem::read_symlink("/proc/self/exe").parent_path() / "maggic",
                std::move(arguments)) {}

  /// Starts `program`, searched for in PATH where it is a mere name; its exit code is 127 when it
  /// is not there.
  Program(const std::filesystem::path& folder, std::string program,
          std::vector<std::string> arguments)
      : out_(folder / "stdout.txt"), err_(folder / "stderr.txt") {
    std::vector<char*> argv{program.data()};
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ < 0) throw std::runtime_error("cannot fork");
    if (pid_ > 0) return;
    constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC;
    const int null = ::open("/dev/null", O_RDONLY);
    const int out = ::open(out_.c_str(), kFlags, 0600);
    const int err = ::open(err_.c_str(), kFlags, 0600);
    if (::dup2(null, 0) < 0 || ::dup2(out, 1) < 0 || ::dup2(err, 2) < 0) ::_exit(126);
    ::execvp(argv[0], argv.data());
    ::_exit(127);
  }
  ~Program() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// What it has said so far.
  std::string err() const { return text_of(err_); }

  void send(int signal) const { ::kill(pid_, signal); }

  /// Waits for its end. @throws std::runtime_error when it takes longer than `patience`.
  ProgramResult wait(std::chrono::seconds patience = std::chrono::seconds(120)) {
    const auto give_up = std::chrono::steady_clock::now() + patience;
    int status = 0;
    while (::waitpid(pid_, &status, WNOHANG) == 0) {
      if (std::chrono::steady_clock::now() > give_up) {
        throw std::runtime_error("the program did not end; it said: " + text_of(err_));
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    pid_ = 0;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out_), text_of(err_)};
  }

 private:
  std::filesystem::path out_;
  std::filesystem::path err_;
  pid_t pid_ = 0;
};

}  // namespace maggic::testing
