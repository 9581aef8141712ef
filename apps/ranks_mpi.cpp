#include <mpi.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

#include "apps/ranks.hpp"

namespace sketchloc {
namespace {

constexpr int kLeader = 0;

/// What a message is about.
enum Tag : int {
  kHello,    ///< to the leader: what the sender's work is
  kAsk,      ///< to the leader: for a piece
  kPiece,    ///< the answer: its number; empty: there is nothing left
  kResult,   ///< to the leader, after the piece's number and a space
  kFailure,  ///< to the leader: why
  kBye       ///< to the leader: nothing more will come
};

struct Message {
  int from = kLeader;
  int tag = kBye;
  std::string text;
};

void send(int to, Tag tag, const std::string& text = {}) {
  MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, to, tag, MPI_COMM_WORLD);
}

Message receive(MPI_Status status) {
  int size = 0;
  MPI_Get_count(&status, MPI_CHAR, &size);
  Message message{.from = status.MPI_SOURCE,
                  .tag = status.MPI_TAG,
                  .text = std::string(static_cast<std::size_t>(size), '\0')};
  MPI_Recv(message.text.data(), size, MPI_CHAR, message.from, message.tag, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return message;
}

Message wait_for_message() {
  while (true) {
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
    if (there != 0) {
      return receive(status);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // MPI's own wait burns a core
  }
}

/// The pieces that the others do, as the leader sees them.
class Counter {
 public:
  Counter(PieceQueue& queue, const TextWork& work) : queue_(queue), work_(work) {}

  /// Until so many have said goodbye.
  void serve(int others) {
    while (others > 0) {
      const Message message = wait_for_message();
      others -= message.tag == kBye ? 1 : 0;
      try {
        answer(message);
      } catch (...) {
        queue_.fail(std::current_exception());
      }
    }
  }

 private:
  void answer(const Message& message) {
    if (message.tag == kAsk) {
      const std::optional<std::size_t> piece = queue_.take();
      send(message.from, kPiece, piece ? std::to_string(work_.pieces.at(*piece)) : "");
    } else if (message.tag == kResult) {
      const std::size_t space = message.text.find(' ');
      work_.keep(std::stoul(message.text.substr(0, space)), message.text.substr(space + 1));
      queue_.finish();
    } else if (message.tag == kFailure) {
      throw std::runtime_error(fmt::format("rank {}: {}", message.from, message.text));
    } else if (message.tag == kHello && message.text != work_.what) {
      throw std::runtime_error(fmt::format(
          "rank {} has other options, inputs or another version of the program; give all the same",
          message.from));
    }
  }

  PieceQueue& queue_;
  const TextWork& work_;
};

/// Threads of this process, where all processes of this machine share its cores.
unsigned threads_here(unsigned jobs) {
  if (jobs > 0) {
    return jobs;
  }
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  int processes = 1;
  MPI_Comm_size(machine, &processes);
  MPI_Comm_free(&machine);
  return std::max(1U, thread_count(0) / static_cast<unsigned>(processes));
}

}  // namespace

/// From MPI_Init to MPI_Finalize.
class Ranks::Link {
 public:
  Link() {
    int support = MPI_THREAD_SINGLE;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &support);
    if (support < MPI_THREAD_SERIALIZED) {
      throw std::runtime_error("this MPI cannot be used from threads; leave out mpirun");
    }
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
    threads_ = threads_here(0);
  }
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  ~Link() {
    if (!leads()) {
      send(kLeader, kBye);
    } else if (!served_) {  // it failed before there was anything to do
      const TextWork nothing;
      PieceQueue empty(0);
      Counter(empty, nothing).serve(count_ - 1);
    }
    MPI_Finalize();
  }

  bool leads() const { return rank_ == kLeader; }
  unsigned threads(unsigned jobs) const { return jobs > 0 ? jobs : threads_; }

  void serve(PieceQueue& queue, const TextWork& work) {
    served_ = true;
    Counter(queue, work).serve(count_ - 1);
  }

  std::optional<std::size_t> ask() {
    const std::scoped_lock lock(talking_);
    send(kLeader, kAsk);
    MPI_Status status;
    MPI_Probe(kLeader, kPiece, MPI_COMM_WORLD, &status);
    const Message answer = receive(status);
    return answer.text.empty() ? std::nullopt : std::optional(std::stoul(answer.text));
  }

  void tell(Tag tag, const std::string& text) {
    const std::scoped_lock lock(talking_);
    send(kLeader, tag, text);
  }

 private:
  int rank_ = 0;
  int count_ = 1;
  unsigned threads_ = 1;
  bool served_ = false;
  std::mutex talking_;  ///< MPI is used by one thread at a time
};

Ranks::Ranks() : link_(processes_started() > 1 ? std::make_unique<Link>() : nullptr) {}

Ranks::~Ranks() = default;

bool Ranks::leads() const { return !link_ || link_->leads(); }

void Ranks::lead(const TextWork& work, unsigned jobs,
                 const std::function<void(std::size_t)>& done) {
  PieceQueue queue(work.pieces.size());
  std::jthread server;
  if (link_) {
    server = std::jthread([&] { link_->serve(queue, work); });
  }
  work_through(queue, link_ ? link_->threads(jobs) : jobs, hire_here(work), done);
}

void Ranks::follow(const TextWork& work, unsigned jobs) {
  link_->tell(kHello, work.what);
  const auto run_worker = [&](std::size_t /*thread*/) {
    try {
      const auto worker = work.hire();
      while (const std::optional<std::size_t> piece = link_->ask()) {
        link_->tell(kResult, std::to_string(*piece) + " " + worker(*piece));
      }
    } catch (const std::exception& error) {
      fail(error.what());  // now, not when the other threads have ended
    }
  };
  const unsigned threads = link_->threads(jobs);
  work_in_parallel(threads, threads, run_worker, [](std::size_t) {});
}

void Ranks::fail(const std::string& why) { link_->tell(kFailure, why); }

}  // namespace sketchloc
