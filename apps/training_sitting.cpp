#include "apps/training_sitting.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>

#include "apps/interrupt.hpp"
#include "apps/progress.hpp"
#include "apps/read_bytes.hpp"
#include "datasets/io/atomic_file.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

class TrainingSitting {
 public:
  TrainingSitting(LearningTask& task, const TrainingSittingPlan& plan)
      : task_(task), plan_(plan), header_(curve_header(task.columns())), curve_(header_) {}

  void run() {
    open_folder();
    start_ = Clock::now();
    try {
      learn();
    } catch (const Interrupted&) {
      save();
      throw Interrupted("interrupted; go on with --resume");
    }
  }

 private:
  void open_folder() {
    const bool begun = fs::exists(plan_.out / "checkpoint.pt");
    if (begun && plan_.resume) {
      task_.restore(bytes_of(plan_.out / "checkpoint.pt"));
      const fs::path curve = plan_.out / "curve.csv";
      curve_ = curve_until(fs::exists(curve) ? bytes_of(curve) : "", header_, samples_learned());
      seconds_before_ = seconds_of_curve(curve_);
      spdlog::info("go on after {} samples", samples_learned());
      return;
    }
    if (!plan_.force && fs::exists(plan_.out) && !fs::is_empty(plan_.out)) {
      throw std::invalid_argument(plan_.out.string() +
                                  " is not empty; give --resume to go on, or --force");
    }
    fs::create_directories(plan_.out);
    write_atomically(plan_.out / "run.yaml", run_file_text(plan_.made_by));
  }

  std::uint64_t batches(std::uint64_t samples) const {
    return batches_of(samples, task_.samples_per_batch());
  }
  std::uint64_t samples_learned() const {
    return task_.batches_learned() * static_cast<std::uint64_t>(task_.samples_per_batch());
  }

  void learn() {
    const std::uint64_t total = batches(plan_.samples);
    const std::uint64_t last =
        plan_.stop_after == 0 ? total : std::min(total, batches(plan_.stop_after));
    const std::uint64_t every = batches(plan_.validate_every);
    Progress progress("train", last);
    if (task_.batches_learned() < last) {
      task_.go_on(plan_.out / "network.onnx");
    }
    while (task_.batches_learned() < last) {
      task_.learn_batch();
      const std::uint64_t done = task_.batches_learned();
      if (done % every == 0 || done == total) {
        record();
      } else if (done == last) {
        save();  // no point of the curve: its network is that of the last one
      }
      if (done % every == 0 && done < last) {
        task_.go_on(plan_.out / "network.onnx");
      }
      progress.update(done);
    }
  }

  void save() const { write_atomically(plan_.out / "checkpoint.pt", task_.checkpoint()); }

  /// The checkpoint comes last: a curve may be ahead of it, never behind.
  void record() {
    const Measured measured = task_.measure();
    const std::chrono::duration<double> sitting = Clock::now() - start_;
    curve_ += curve_row(samples_learned(), seconds_before_ + sitting.count(), measured.columns);
    write_atomically(plan_.out / "curve.csv", curve_);
    if (const std::string picture = curve_svg(curve_, task_.panels()); !picture.empty()) {
      write_atomically(plan_.out / "curve.svg", picture);
    }
    write_atomically(plan_.out / "network.onnx", task_.network());
    save();
    spdlog::info("{} samples: {}", samples_learned(), measured.summary);
  }

  LearningTask& task_;
  const TrainingSittingPlan& plan_;
  std::string header_;
  std::string curve_;
  double seconds_before_ = 0.0;
  Clock::time_point start_;
};

}  // namespace

void learn_in_folder(LearningTask& task, const TrainingSittingPlan& plan) {
  TrainingSitting(task, plan).run();
}

}  // namespace sketchloc
