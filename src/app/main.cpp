// Command line in, exit status out: the only place that turns errors into messages.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>

#include "generated/version.hpp"
#include "src/app/pipeline.hpp"
#include "src/app/process/threads.hpp"
#include "src/app/serve.hpp"
#include "src/base/error.hpp"
#include "src/report/error_text.hpp"
#include "src/report/names.hpp"

namespace rockfold {
namespace {

/// A file that the program opens must never become its stdin, stdout or stderr because one of them
/// was closed.
void open_standard_streams() {
  for (int file = 0; file <= 2; ++file)
    if (fcntl(file, F_GETFD) == -1 && errno == EBADF) [[maybe_unused]]
      const int taken = open("/dev/null", file == 0 ? O_RDONLY : O_WRONLY);
}

int tell_error(const Error& error, bool json, Terminal& terminal) {
  if (json) print_error_document(stdout, error);
  for (const auto& line : error_lines(error)) {
    if (json)
      terminal.log(line);
    else
      terminal.error_line(line);
  }
  return exit_status(error.kind());
}

/// Whether all of the answer has left the program. Nobody is told of a reader that stopped reading.
int close_stdout(int status, Terminal& terminal) {
  errno = 0;
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return status;
  if (errno != EPIPE)
    terminal.error_line(fmt::format("rockfold: standard output: {}", std::strerror(errno)));
  return exit_status(ErrorKind::io);
}

/// "0.1.0 (commit): support wedge.toml"
std::string call_text(int argc, char** argv) {
  return fmt::format("{} ({}): {}", version, commit, fmt::join(argv + 1, argv + argc, " "));
}

int run_program(int argc, char** argv);

int answer(int argc, char** argv, bool json, Terminal& terminal) {
  try {
    const Options options = parse_command_line(argc, argv);
    terminal.set_progress(!options.quiet);
    if (!options.log_file.empty()) terminal.log_to(options.log_file, call_text(argc, argv));
    if (options.progress_descriptor > 0) terminal.tell_progress_to(options.progress_descriptor);
    if (options.command == Command::serve)
      return serve_requests([&](std::vector<std::string> arguments) {
        std::vector<char*> words{argv[0]};
        for (std::string& argument : arguments) words.push_back(argument.data());
        return run_program(static_cast<int>(words.size()), words.data());
      });
    return run_command(options, terminal);
  } catch (const Notice& notice) {
    std::fputs(notice.text.c_str(), stdout);
    return 0;
  } catch (const Error& error) {
    return tell_error(error, json, terminal);
  } catch (const std::bad_alloc&) {
    return tell_error(Error(ErrorKind::analysis, "out of memory"), json, terminal);
  } catch (const std::exception& error) {
    return tell_error(Error(ErrorKind::analysis, fmt::format("internal error: {}", error.what())),
                      json, terminal);
  }
}

int run_program(int argc, char** argv) {
  Terminal terminal(stderr, detect_terminal(stderr));
  const int status = close_stdout(answer(argc, argv, wants_json(argc, argv), terminal), terminal);
  terminal.log(fmt::format("exit status {}", status));
  return status;
}

}  // namespace
}  // namespace rockfold

int main(int argc, char** argv) {
  using namespace rockfold;
  keep_waits_short(argv);
  open_standard_streams();
  std::signal(SIGPIPE, SIG_IGN);
  return run_program(argc, argv);
}
