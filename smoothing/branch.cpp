#include "smoothing/branch.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "motion/angles.hpp"

namespace sketchloc {
namespace {

constexpr double kLeastProbability = 1e-3;  ///< no registration is surer to be wrong

/// One entry per hypothesis of a keyframe.
using Logs = Eigen::VectorXd;

/// The keyframes that have hypotheses, and what lies between each and the one before it.
struct Stage {
  std::size_t keyframe = 0;
  Logs evidence;
  double way_m = 0.0;          ///< since the stage before
  Eigen::MatrixXd transition;  ///< log, from the stage before (rows) to this one (columns)
};

Eigen::Vector4d error_between(const Sim2& expected, const Sim2& found) {
  const Sim2 error = expected.inverse() * found;
  return {error.x(), error.y(), error.yaw_rad(), std::log(error.scale())};
}

/// How well one pose follows from another: a Gaussian's exponent, and never less than a jump. The
/// Gaussian is not normalised: hypotheses that are stated widely are not less likely for it.
double log_follows(const Sim2& expected, const Sim2& found, const Eigen::Matrix4d& covariance,
                   double jump_log_odds) {
  const Eigen::Vector4d error = error_between(expected, found);
  const double fit = -0.5 * error.dot(covariance.llt().solve(error));
  const double most = std::max(fit, jump_log_odds);
  return most + std::log1p(std::exp(std::min(fit, jump_log_odds) - most));
}

/// Evidence of a registration grows with the way: the scans that it looks at are partly those of
/// the last keyframe's.
Logs evidence_of(const Keyframe& keyframe, const SmoothingParams& params, bool is_first) {
  constexpr double kNewAfterM = 0.5;
  const double share =
      params.independent_share * (is_first ? 1.0 : std::min(1.0, keyframe.way_m / kNewAfterM));
  Logs logs(static_cast<Eigen::Index>(keyframe.hypotheses.size()));
  for (Eigen::Index i = 0; i < logs.size(); ++i) {
    const double p = std::clamp(keyframe.hypotheses[static_cast<std::size_t>(i)].inlier_probability,
                                kLeastProbability, params.max_probability);
    logs[i] = share * std::log(p / (1.0 - p));
  }
  return logs;
}

Eigen::MatrixXd start_transition(const KeyframeRun& run, const Keyframe& first,
                                 const SmoothingParams& params) {
  Eigen::MatrixXd transition =
      Eigen::MatrixXd::Zero(1, static_cast<Eigen::Index>(first.hypotheses.size()));
  if (run.start_sketch_from_robot) {
    const Eigen::Matrix4d spread = start_covariance(params);
    for (std::size_t i = 0; i < first.hypotheses.size(); ++i) {
      const PoseHypothesis& one = first.hypotheses[i];
      transition(0, static_cast<Eigen::Index>(i)) =
          log_follows(*run.start_sketch_from_robot, one.sketch_from_robot, spread + one.covariance,
                      params.jump_log_odds);
    }
  }
  return transition;
}

Eigen::MatrixXd transition_between(const Keyframe& before, const Keyframe& now,
                                   const Eigen::Matrix4d& walk, double jump_log_odds) {
  const Se2 before_from_now = before.odom_from_robot.inverse() * now.odom_from_robot;
  Eigen::MatrixXd transition(static_cast<Eigen::Index>(before.hypotheses.size()),
                             static_cast<Eigen::Index>(now.hypotheses.size()));
  for (std::size_t i = 0; i < before.hypotheses.size(); ++i) {
    const Sim2 expected = before.hypotheses[i].sketch_from_robot * before_from_now;
    for (std::size_t j = 0; j < now.hypotheses.size(); ++j) {
      const Eigen::Matrix4d covariance =
          walk + before.hypotheses[i].covariance + now.hypotheses[j].covariance;
      transition(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          log_follows(expected, now.hypotheses[j].sketch_from_robot, covariance, jump_log_odds);
    }
  }
  return transition;
}

std::vector<Stage> stages_of(const KeyframeRun& run, const SmoothingParams& params) {
  std::vector<Stage> stages;
  double way_m = 0.0;
  double turn_rad = 0.0;
  for (std::size_t k = 0; k < run.keyframes.size(); ++k) {
    const Keyframe& now = run.keyframes[k];
    way_m += now.way_m;
    turn_rad += now.turn_rad;
    if (now.hypotheses.empty()) {
      continue;
    }
    stages.push_back(
        {.keyframe = k,
         .evidence = evidence_of(now, params, stages.empty()),
         .way_m = way_m,
         .transition = stages.empty()
                           ? start_transition(run, now, params)
                           : transition_between(run.keyframes[stages.back().keyframe], now,
                                                walk_covariance(params.walk, way_m, turn_rad),
                                                params.jump_log_odds)});
    way_m = 0.0;
    turn_rad = 0.0;
  }
  return stages;
}

void choose(const std::vector<Stage>& stages, Branch& branch) {
  std::vector<std::vector<Eigen::Index>> parents;
  Logs best = Logs::Zero(1);
  for (const Stage& stage : stages) {
    Logs next(stage.evidence.size());
    std::vector<Eigen::Index>& parent = parents.emplace_back(stage.evidence.size());
    for (Eigen::Index j = 0; j < next.size(); ++j) {
      const Logs ways = best + stage.transition.col(j);
      next[j] = ways.maxCoeff(&parent[static_cast<std::size_t>(j)]) + stage.evidence[j];
    }
    best = next;
  }
  Eigen::Index at = 0;
  best.maxCoeff(&at);
  for (std::size_t s = stages.size(); s-- > 0;) {
    branch.chosen[stages[s].keyframe] = static_cast<std::size_t>(at);
    at = parents[s][static_cast<std::size_t>(at)];
  }
}

/// Probabilities of going from one stage to the next, the last row and column for being elsewhere,
/// where no hypothesis is. Of hypotheses that are nearly the same, all together follow as one
/// would.
Eigen::MatrixXd markov_of(const Stage& stage, const SmoothingParams& params) {
  const Eigen::Index rows = stage.transition.rows();
  const Eigen::Index columns = stage.transition.cols();
  const double lost = -std::expm1(-stage.way_m / params.lost_way_m);
  const double found = -std::expm1(-stage.way_m / params.found_way_m);
  Eigen::MatrixXd markov(rows + 1, columns + 1);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Eigen::VectorXd follows = stage.transition.row(i).array().exp();
    markov.row(i).head(columns) =
        (1.0 - lost) / (follows.sum() + std::exp(params.jump_log_odds)) * follows.transpose();
    markov(i, columns) = 1.0 - markov.row(i).head(columns).sum();
  }
  markov.row(rows).setConstant(found / static_cast<double>(columns));
  markov(rows, columns) = 1.0 - found;
  return markov;
}

/// How likely each hypothesis makes what was seen, against its being wrong; elsewhere: 1.
Eigen::VectorXd odds_of(const Stage& stage, const SmoothingParams& params) {
  Eigen::VectorXd odds = Eigen::VectorXd::Ones(stage.evidence.size() + 1);
  odds.head(stage.evidence.size()) = (params.certainty * stage.evidence.array()).exp();
  return odds;
}

/// The marginals of all stages, forward and backward, scaled at each so that nothing vanishes.
void weigh(const std::vector<Stage>& stages, double start_elsewhere, const SmoothingParams& params,
           Branch& branch) {
  std::vector<Eigen::VectorXd> forward;
  Eigen::VectorXd message(2);
  message << 1.0 - start_elsewhere, start_elsewhere;
  for (const Stage& stage : stages) {
    message = (markov_of(stage, params).transpose() * message).cwiseProduct(odds_of(stage, params));
    message /= message.sum();
    forward.push_back(message);
  }
  message.setOnes();
  for (std::size_t s = stages.size(); s-- > 0;) {
    const Eigen::VectorXd all = forward[s].cwiseProduct(message);
    const Eigen::VectorXd probability = all.head(all.size() - 1) / all.sum();
    branch.probability[stages[s].keyframe].assign(probability.begin(), probability.end());
    message = markov_of(stages[s], params) * odds_of(stages[s], params).cwiseProduct(message);
    message /= message.sum();
  }
}

/// What the other keyframe of a pair says of each hypothesis of this one, against the pair's being
/// wrong: the more, the likelier the other's hypotheses are that lie beside it.
Logs told_by_pair(const KeyframeRun& run, const KeyframePair& pair, std::size_t of,
                  const Branch& branch, const SmoothingParams& params) {
  const std::size_t other = of == pair.later ? pair.earlier : pair.later;
  const Se2 other_from_this =
      of == pair.later ? pair.earlier_from_later : pair.earlier_from_later.inverse();
  const std::vector<PoseHypothesis>& here = run.keyframes[of].hypotheses;
  const std::vector<PoseHypothesis>& there = run.keyframes[other].hypotheses;
  Logs told(static_cast<Eigen::Index>(here.size()));
  for (std::size_t j = 0; j < here.size(); ++j) {
    double beside = 0.0;
    for (std::size_t i = 0; i < there.size(); ++i) {
      const Eigen::Vector4d error =
          error_between(there[i].sketch_from_robot * other_from_this, here[j].sketch_from_robot);
      const Eigen::Matrix4d covariance =
          pair_covariance(params) + there[i].covariance + here[j].covariance;
      beside +=
          branch.probability[other][i] * std::exp(-0.5 * error.dot(covariance.llt().solve(error)));
    }
    told[static_cast<Eigen::Index>(j)] =
        std::log1p(pair.probability * std::min(beside, 1.0) / (1.0 - pair.probability));
  }
  return told;
}

/// The stages with what pairs say, as far as each keyframe is known by now. Neighbouring keyframes
/// of two passes make as many pairs that err together, so they count like registrations.
std::vector<Stage> with_pairs(std::vector<Stage> stages, const KeyframeRun& run,
                              const Branch& branch, const SmoothingParams& params) {
  std::vector<Stage*> stage_of(run.keyframes.size(), nullptr);
  for (Stage& stage : stages) {
    stage_of[stage.keyframe] = &stage;
  }
  for (const KeyframePair& pair : run.pairs) {
    if (stage_of[pair.earlier] == nullptr || stage_of[pair.later] == nullptr) {
      continue;
    }
    for (const std::size_t keyframe : {pair.earlier, pair.later}) {
      stage_of[keyframe]->evidence +=
          params.independent_share * told_by_pair(run, pair, keyframe, branch, params);
    }
  }
  return stages;
}

}  // namespace

Branch find_branch(const KeyframeRun& run, const SmoothingParams& params) {
  Branch branch{.chosen = std::vector<std::optional<std::size_t>>(run.keyframes.size()),
                .probability = std::vector<std::vector<double>>(run.keyframes.size())};
  const std::vector<Stage> alone = stages_of(run, params);
  if (alone.empty()) {
    return branch;
  }
  const auto decide = [&](const std::vector<Stage>& stages) {
    choose(stages, branch);
    weigh(stages,
          run.start_sketch_from_robot ? 1.0 - run.start_probability : params.start_elsewhere,
          params, branch);
  };
  decide(alone);
  for (int round = 0; round < params.pair_rounds && !run.pairs.empty(); ++round) {
    decide(with_pairs(alone, run, branch, params));
  }
  return branch;
}

}  // namespace sketchloc
