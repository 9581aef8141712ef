#pragma once

#include <cstddef>

#include "apps/message_source.hpp"
#include "datasets/run.hpp"

namespace sketchloc {

/// The steps of a log, each at its time.
class ReplaySource final : public MessageSource {
 public:
  /// `rate`: seconds of the log per second; 0: each step as soon as somebody asks. The run must
  /// outlive the source.
  ReplaySource(const Run& run, double rate) : run_(run), rate_(rate) {}

  std::vector<Arrival> receive(double wait_s) override;
  bool at_end() const override { return next_ == run_.steps.size(); }

 private:
  double due_s(std::size_t step) const;

  const Run& run_;
  double rate_;
  double begin_s_ = 0.0;
  std::size_t next_ = 0;
};

}  // namespace sketchloc
