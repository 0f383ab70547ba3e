#include "src/sweep/processes/run_queue.hpp"

#include <charconv>
#include <ctime>

#include "src/base/interrupt.hpp"

// Messages to rank 0: "next", a run's line of the journal, "bye"; from it: the number of a run, or "none".

namespace rockfold::sweep {

namespace {

constexpr const char* ask = "next";
constexpr const char* nothing_left = "none";
constexpr const char* farewell = "bye";

void sleep_shortly() {
  const timespec millisecond{0, 1'000'000};
  nanosleep(&millisecond, nullptr);
}

class ListQueue : public RunQueue {
 public:
  ListQueue(std::vector<Index> left, std::function<void(const RunRecord&)> ended, MpiLink* link)
      : left_(left.begin(), left.end()),
        ended_(std::move(ended)),
        link_(link),
        others_(link ? link->size() - 1 : 0) {}

  std::optional<Index> next() override {
    serve();
    return take();
  }
  bool over() override {
    serve();
    return left_.empty() && others_ == 0;
  }
  void ended(const RunRecord& run) override { ended_(run); }
  void close() override {
    while (others_ > 0) {
      serve();
      sleep_shortly();
    }
  }
  bool shared() const override { return link_ != nullptr; }

 private:
  std::optional<Index> take() {
    if (left_.empty() || interrupt_signal != 0) return {};
    const Index run = left_.front();
    left_.pop_front();
    return run;
  }

  void serve() {
    while (const auto message = link_ ? link_->receive() : std::nullopt) {
      if (message->text == farewell) {
        --others_;
      } else if (message->text == ask) {
        const auto run = take();
        link_->send(message->from, run ? std::to_string(*run) : nothing_left);
      } else {
        ended_(run_from_line(message->text));
      }
    }
  }

  std::deque<Index> left_;
  std::function<void(const RunRecord&)> ended_;
  MpiLink* link_;
  int others_;  ///< processes that have not said good-bye
};

class RemoteQueue : public RunQueue {
 public:
  explicit RemoteQueue(MpiLink& link) : link_(link) { link_.send(0, ask); }

  /// One run is in hand always, so that none is waited for.
  std::optional<Index> next() override {
    listen();
    if (!in_hand_) return {};
    link_.send(0, ask);
    asked_ = true;
    return std::exchange(in_hand_, std::nullopt);
  }
  bool over() override {
    listen();
    return !asked_ && !in_hand_;
  }
  void ended(const RunRecord& run) override { link_.send(0, line_of(run)); }
  void close() override {
    while (asked_) {
      listen();
      sleep_shortly();
    }
    link_.send(0, farewell);
  }
  bool shared() const override { return true; }

 private:
  void listen() {
    while (const auto message = link_.receive()) {
      asked_ = false;
      if (message->text == nothing_left) continue;
      Index run = 0;
      std::from_chars(message->text.data(), message->text.data() + message->text.size(), run);
      in_hand_ = run;
    }
  }

  MpiLink& link_;
  bool asked_ = true;
  std::optional<Index> in_hand_;
};

}  // namespace

std::unique_ptr<RunQueue> list_queue(std::vector<Index> left,
                                     std::function<void(const RunRecord&)> ended, MpiLink* link) {
  return std::make_unique<ListQueue>(std::move(left), std::move(ended), link);
}

std::unique_ptr<RunQueue> remote_queue(MpiLink& link) {
  return std::make_unique<RemoteQueue>(link);
}

}  // namespace rockfold::sweep
