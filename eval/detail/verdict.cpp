#include "eval/detail/verdict.hpp"

#include "eval/detail/text.hpp"

namespace sketchloc::detail {

Verdict judge(const SketchErrors& errors, double loss_bound_m) {
  constexpr double kLocatedShare = 0.75;
  if (errors.scored == 0) {
    return {.kind = Verdict::Kind::Unknown, .headline = "No reference to compare with"};
  }
  const std::string within = percent(errors.share_within_2_m) + " of the steps within 2 m";
  if (errors.lost_at_end) {
    return {.kind = Verdict::Kind::Lost,
            .headline = "Lost: at the end more than " + short_number(loss_bound_m) + " m off"};
  }
  if (errors.first_loss_s) {
    return {.kind = Verdict::Kind::Partly,
            .headline = "Partly located: lost on the way, found again, " + within};
  }
  if (errors.share_within_2_m < kLocatedShare) {
    return {.kind = Verdict::Kind::Partly, .headline = "Partly located: only " + within};
  }
  return {.kind = Verdict::Kind::Located, .headline = "Located: " + within + ", never lost"};
}

}  // namespace sketchloc::detail
