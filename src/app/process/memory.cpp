#include "src/app/process/memory.hpp"

#include <cstdio>
#include <cstdlib>

#include <fcntl.h>
#include <unistd.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace rockfold {

void return_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

Real resident_bytes(int process) {
  char path[64] = "/proc/self/statm", text[128];
  if (process != 0) std::snprintf(path, sizeof path, "/proc/%d/statm", process);
  const int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  const ssize_t length = read(file, text, sizeof text - 1);
  close(file);
  if (length <= 0) return 0;
  text[length] = '\0';
  long long pages = 0;  // the second number (proc(5)); the first is the address space
  if (std::sscanf(text, "%*d %lld", &pages) != 1) return 0;
  return static_cast<Real>(pages) * static_cast<Real>(sysconf(_SC_PAGESIZE));
}

}  // namespace rockfold
