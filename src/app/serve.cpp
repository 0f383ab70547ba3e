#include "src/app/serve.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "src/base/error.hpp"
#include "src/report/names.hpp"

namespace rockfold {

namespace {

struct Request {
  std::vector<std::string> arguments;
  std::string folder, input;
};

std::optional<Request> request_from(const std::string& line) {
  try {
    const auto json = nlohmann::json::parse(line);
    return Request{json.at("arguments").get<std::vector<std::string>>(),
                   json.value("folder", std::string()), json.value("input", std::string())};
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

[[noreturn]] void fail(const char* what) {
  throw Error(ErrorKind::io, fmt::format("{}: {}", what, std::strerror(errno)));
}

void write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = write(file, text.data() + done, text.size() - done);
    if (written < 0 && errno != EINTR) fail("writing");
    if (written > 0) done += static_cast<std::size_t>(written);
  }
}

std::string read_all(int file) {
  std::string text;
  std::vector<char> chunk(std::size_t{1} << 16);
  for (;;) {
    const ssize_t count = read(file, chunk.data(), chunk.size());
    if (count == 0 || (count < 0 && errno != EINTR)) return text;
    if (count > 0) text.append(chunk.data(), static_cast<std::size_t>(count));
  }
}

/// In the child: the request as if it had been typed.
int answer_request(const Request& request, int input, int output,
                   const std::function<int(const std::vector<std::string>&)>& run) {
  if (dup2(input, STDIN_FILENO) < 0 || dup2(output, STDOUT_FILENO) < 0 ||
      (!request.folder.empty() && chdir(request.folder.c_str()) != 0)) {
    std::fprintf(stderr, "rockfold: %s: %s\n", request.folder.c_str(), std::strerror(errno));
    return exit_status(ErrorKind::io);
  }
  return run(request.arguments);
}

struct Reply {
  int status = 0;
  std::string output;
};

Reply reply_to(const Request& request,
               const std::function<int(const std::vector<std::string>&)>& run) {
  const int input = memfd_create("input", MFD_CLOEXEC);
  int ends[2];
  if (input < 0 || pipe(ends) != 0) fail("a request");
  write_all(input, request.input);
  lseek(input, 0, SEEK_SET);
  const pid_t child = fork();
  if (child < 0) fail("a request");
  if (child == 0) {
    close(ends[0]);
    const int status = answer_request(request, input, ends[1], run);
    std::fflush(nullptr);
    _exit(status);
  }
  close(input);
  close(ends[1]);
  Reply reply;
  reply.output = read_all(ends[0]);
  close(ends[0]);
  int how = 0;
  while (waitpid(child, &how, 0) < 0 && errno == EINTR) {
  }
  reply.status = WIFEXITED(how) ? WEXITSTATUS(how) : 128 + WTERMSIG(how);
  return reply;
}

}  // namespace

int serve_requests(const std::function<int(const std::vector<std::string>&)>& run) {
  std::string line;
  while (std::getline(std::cin, line)) {
    const std::optional<Request> request = request_from(line);
    const Reply reply =
        request ? reply_to(*request, run) : Reply{exit_status(ErrorKind::usage), ""};
    write_all(STDOUT_FILENO, fmt::format("{{\"status\": {}, \"bytes\": {}}}\n", reply.status,
                                         reply.output.size()));
    write_all(STDOUT_FILENO, reply.output);
  }
  return 0;
}

}  // namespace rockfold
