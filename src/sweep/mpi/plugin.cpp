// The only file that knows MPI: a module of its own, which the program loads where a launcher of MPI started it (src/sweep/processes/mpi_link.hpp).
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

#include "src/sweep/processes/mpi_link.hpp"

namespace {

constexpr int tag = 0;

void send(int to, const char* text, int length) {
  MPI_Send(text, length, MPI_CHAR, to, tag, MPI_COMM_WORLD);
}

int waiting(int* from) {
  int there = 0, length = -1;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &there, &status);
  if (there == 0) return -1;
  *from = status.MPI_SOURCE;
  MPI_Get_count(&status, MPI_CHAR, &length);
  return length;
}

void receive(int from, char* text, int length) {
  MPI_Recv(text, length, MPI_CHAR, from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
}

void finish() {
  MPI_Finalize();
}

}  // namespace

extern "C" const rockfold::sweep::MpiFunctions* rockfold_mpi_start() {
  static rockfold::sweep::MpiFunctions functions{0, 1, send, waiting, receive, finish};
  MPI_Init(nullptr, nullptr);
  MPI_Comm_rank(MPI_COMM_WORLD, &functions.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &functions.size);
  return &functions;
}
