// Which run is next, here and in the other processes of the sweep, and who hears of its end.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "src/sweep/processes/mpi_link.hpp"
#include "src/sweep/sweep_record.hpp"

namespace rockfold::sweep {

class RunQueue {
 public:
  RunQueue() = default;
  RunQueue(const RunQueue&) = delete;
  RunQueue& operator=(const RunQueue&) = delete;
  virtual ~RunQueue() = default;

  /// A run to start here; none where there is none left, or none yet.
  virtual std::optional<Index> next() = 0;
  /// Whether next() will have no more.
  virtual bool over() = 0;
  virtual void ended(const RunRecord& run) = 0;
  /// Nothing is running here any more: waits for the others' ends.
  virtual void close() {}
  /// Whether there are others to listen to.
  virtual bool shared() const { return false; }
};

/// The list `left`, handed out in its order; to other processes too, where there is a link.
std::unique_ptr<RunQueue> list_queue(std::vector<Index> left,
                                     std::function<void(const RunRecord&)> ended, MpiLink* link);
/// That of rank 0, asked by another rank.
std::unique_ptr<RunQueue> remote_queue(MpiLink& link);

}  // namespace rockfold::sweep
