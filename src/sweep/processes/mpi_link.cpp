#include "src/sweep/processes/mpi_link.hpp"

#include <cstdlib>
#include <exception>
#include <filesystem>

#include <dlfcn.h>

#include "src/base/error.hpp"

namespace fs = std::filesystem;

namespace rockfold::sweep {

namespace {

constexpr const char* plugin_name = "rockfold_mpi.so";

/// Set by Open MPI's mpirun, by those of MPICH and its kin, and by `srun --mpi=pmix`.
bool started_by_mpi() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* size = std::getenv(name)) return std::atoi(size) > 1;
  return std::getenv("PMIX_RANK") != nullptr;
}

/// Beside the program in a build tree, below lib/rockfold where it is installed.
std::string plugin_path() {
  std::error_code ignored;
  const fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const fs::path& path :
       {folder / plugin_name, folder / ".." / ROCKFOLD_LIBDIR / "rockfold" / plugin_name})
    if (fs::exists(path, ignored)) return path.string();
  return "";
}

[[noreturn]] void refuse(const std::string& why) {
  throw Error(
      ErrorKind::usage,
      "was started several times by MPI, but " + why +
          ": each process would do the whole sweep. Run it without mpirun, or build it where "
          "libopenmpi-dev, or another MPI, is installed");
}

}  // namespace

std::unique_ptr<MpiLink> MpiLink::open() {
  if (!started_by_mpi()) return {};
  const std::string path = plugin_path();
  if (path.empty()) refuse("has no " + std::string(plugin_name) + " beside it");
  // Global: MPI's own plug-ins look for its symbols.
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (library == nullptr) refuse(dlerror());
  using Start = const MpiFunctions* (*)();
  const auto start = reinterpret_cast<Start>(dlsym(library, "rockfold_mpi_start"));
  if (start == nullptr) refuse(path + " is of another version");
  auto link = std::unique_ptr<MpiLink>(new MpiLink(start()));
  if (link->size() > 1) return link;
  return {};
}

MpiLink::MpiLink(const MpiFunctions* functions)
    : functions_(functions), exceptions_(std::uncaught_exceptions()) {}

MpiLink::~MpiLink() {
  if (std::uncaught_exceptions() == exceptions_) functions_->finish();
}

void MpiLink::send(int to, const std::string& text) {
  functions_->send(to, text.data(), static_cast<int>(text.size()));
}

std::optional<MpiLink::Message> MpiLink::receive() {
  Message message;
  const int length = functions_->waiting(&message.from);
  if (length < 0) return {};
  message.text.resize(static_cast<std::size_t>(length));
  functions_->receive(message.from, message.text.data(), length);
  return message;
}

}  // namespace rockfold::sweep
