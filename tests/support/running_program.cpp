#include "tests/support/running_program.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>

namespace sketchloc::testing {

RunningProgram::RunningProgram(const std::vector<std::string>& command) {
  std::signal(SIGPIPE, SIG_IGN);
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error("no pipe");
  }
  const std::string out_file = (folder_ / "out").string();
  const std::string err_file = (folder_ / "err").string();
  std::vector<char*> arguments;
  for (const std::string& word : command) {
    arguments.push_back(const_cast<char*>(word.c_str()));  // execv does not change them
  }
  arguments.push_back(nullptr);
  child_ = ::fork();
  if (child_ == 0) {
    std::signal(SIGPIPE, SIG_DFL);
    ::dup2(pipe[0], STDIN_FILENO);
    ::dup2(::open(out_file.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
    ::dup2(::open(err_file.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    ::execv(arguments[0], arguments.data());
    ::_exit(127);
  }
  ::close(pipe[0]);
  stdin_ = pipe[1];
}

RunningProgram::~RunningProgram() {
  close_stdin();
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
}

void RunningProgram::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(stdin_, text.data(), text.size());
    if (count <= 0) {
      return;
    }
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

void RunningProgram::close_stdin() {
  if (stdin_ >= 0) {
    ::close(stdin_);
    stdin_ = -1;
  }
}

void RunningProgram::send_signal(int signal) const { ::kill(child_, signal); }

bool RunningProgram::wait_until(const std::function<bool()>& holds) {
  for (int i = 0; i < 6000; ++i) {
    if (holds()) {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

CommandResult RunningProgram::wait() {
  close_stdin();
  int status = 0;
  if (!wait_until([&] { return ::waitpid(child_, &status, WNOHANG) == child_; })) {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, &status, 0);
  }
  child_ = -1;
  return {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1, .out = out(), .err = err()};
}

std::string exchange_by_tcp(int port, std::string_view text) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    ::close(socket);
    throw std::runtime_error("nobody listens");
  }
  std::thread sender([&] {
    while (!text.empty()) {
      const ssize_t count = ::send(socket, text.data(), text.size(), MSG_NOSIGNAL);
      if (count <= 0) {
        break;
      }
      text.remove_prefix(static_cast<std::size_t>(count));
    }
    ::shutdown(socket, SHUT_WR);
  });
  std::string answers;
  std::array<char, 4096> bytes{};
  for (ssize_t count = 1; count > 0;) {
    count = ::recv(socket, bytes.data(), bytes.size(), 0);
    answers.append(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  }
  sender.join();
  ::close(socket);
  return answers;
}

}  // namespace sketchloc::testing
