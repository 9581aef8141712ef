#pragma once

namespace sketchloc {

/// How a network learns.
struct TrainerParams {
  double learning_rate = 1e-3;       ///< of Adam at the start, > 0
  double last_learning_rate = 1e-5;  ///< at the end, in (0, learning_rate]
  int warm_up_batches = 400;         ///< the first ones, with a rising rate, >= 0
  /// Of all samples, the last ones, with a rate that falls linearly; in [0, 1]. Before them the
  /// rate does not depend on how many are to come, so that learning may be prolonged.
  double fall_share = 0.3;
  double averaging = 0.999;    ///< the network that is used follows by 1 - this, in [0, 1)
  double max_gradient = 10.0;  ///< longer gradients are shortened, > 0
};

template <typename Visitor>
void visit_fields(TrainerParams& trainer, Visitor&& visit) {
  visit("learning_rate", trainer.learning_rate);
  visit("last_learning_rate", trainer.last_learning_rate);
  visit("warm_up_batches", trainer.warm_up_batches);
  visit("fall_share", trainer.fall_share);
  visit("averaging", trainer.averaging);
  visit("max_gradient", trainer.max_gradient);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const TrainerParams& params);

}  // namespace sketchloc
