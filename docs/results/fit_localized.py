#!/usr/bin/env python3
"""Fits the numbers of LocalizedParams (filter/localized_belief.hpp) to runs of `sketchloc ablate
--suite robust` made without challengers: least log loss of the stated probability over all steps.

    sketchloc ablate --suite robust --seed 521 --seeds 1 --methods mcl,ours --drives.drawings 1 \
        --filter.localizer.challengers.count 0 --out OUT
    docs/results/fit_localized.py OUT/trials.jsonl [MORE/trials.jsonl ...]

Not fitted: the contradiction at which a robot counts as carried (simulated drives have at most 0.05 and carried
robots 0.2 and more, so that anything between fits), and found_way_m, which is held at 50 m: with less, a robot that is
lost for good can never be sure of it, and no challenger would take over. Steps of `mcl` set no more than its bias.

Coordinate descent with shrinking steps; no packages needed, some minutes. Prints the loss of what the runs stated
too. The runs must be on other buildings than those that anything is judged on.
"""
import json
import math
import sys

RIGHT_M, RIGHT_RAD = 2.0, 0.5236
CARRIED, CARRIED_SLOPE, FOUND_M = 0.1, 100.0, 50.0
MOST_LOG_ODDS = 20.0
MOST_PLACE = 7.0
LEAST = 1e-3

# Name, where the search starts, its first step, its least value.
REGISTERED = [("place", 1.0, 0.4, -math.inf), ("quality_mean", 3.0, 1.0, -math.inf),
              ("quality_sigma", 1.0, 0.4, 0.05), ("log quality_way_m", 3.0, 0.7, 0.0),
              ("right_sigma", 2.0, 0.5, 0.1), ("wrong_mean", -0.5, 0.5, -math.inf),
              ("wrong_sigma", 3.0, 0.7, 0.1), ("log lost_way_m", 4.7, 0.5, 1.0),
              ("max_ratio", 4.0, 1.0, 0.1)]
BEAMS = [("bias", 0.0, 0.5, -math.inf), ("evidence", 0.0, 0.5, -math.inf),
         ("log lost_way_m", 4.7, 0.5, 1.0), ("max_ratio", 4.0, 1.0, 0.1)]


def log_odds(p):
    p = min(max(p, LEAST), 1 - LEAST)
    return math.log(p / (1 - p))


def read(path, method):
    trials = []
    for line in open(path):
        trial = json.loads(line)
        if trial["method"] != method:
            continue
        errors = trial["errors"]
        steps = []
        for i, signs in enumerate(errors["signs"]):
            right = errors["translation_m"][i] <= RIGHT_M and errors["heading_rad"][i] <= RIGHT_RAD
            if signs is not None:
                place = min(max(signs[4], -MOST_PLACE), MOST_PLACE)
                signs = (signs[0], signs[1], signs[2],
                         log_odds(0.5 if signs[3] is None else signs[3]), place)
            steps.append((signs, errors["share_within_bounds"][i], right,
                          errors["localized_probability"][i], errors["contradiction"][i]))
        start = -3.5 if trial["start"] == "anywhere" else 4.0
        trials.append((trial["kind"], start, steps))
    return trials


class Registered:
    """The log-likelihood ratio of registrations, as LocalizedBelief::hear."""

    def __init__(self, params):
        (self.place, self.mean, self.sigma, way, self.right, self.wrong_mean, self.wrong,
         lost, self.most) = params
        self.way_m, self.lost_m = math.exp(way), math.exp(lost)
        self.z, self.variance = 0.0, 1.0

    def drive(self, way, kept):
        memory = math.exp(-way / self.way_m)
        variance = kept * (self.variance + (1 - kept) * self.z ** 2) + 1 - kept
        self.z *= kept * memory
        self.variance = 1 + (variance - 1) * memory ** 2

    def hear(self, new, e, logit, place):
        x = logit + self.place * place
        noise, prior = self.right ** 2 / new, self.sigma ** 2 * self.variance
        innovation = x - self.mean - self.sigma * self.z
        right = (-new * math.log(self.right) - 0.5 * math.log1p(prior / noise)
                 - 0.5 * innovation ** 2 / (noise + prior))
        wrong = -new * (math.log(self.wrong) + 0.5 * ((x - self.wrong_mean) / self.wrong) ** 2)
        gain = prior / (noise + prior)
        self.z += gain * innovation / self.sigma
        self.variance *= 1 - gain
        return right - wrong


class Beams:
    def __init__(self, params):
        self.bias, self.evidence, lost, self.most = params
        self.lost_m = math.exp(lost)

    def drive(self, way, kept):
        pass

    def hear(self, new, e, logit, place):
        return new * (self.bias + self.evidence * e)


def stated(model, start, steps):
    belief = start
    for signs, share, right, _, contradiction in steps:
        stayed = 1 / (1 + math.exp(min(CARRIED_SLOPE * (contradiction - CARRIED), 700.0)))
        p = stayed / (1 + math.exp(-belief))
        belief = max(math.log(max(p, 1e-12) / (1 - p)), -MOST_LOG_ODDS)
        if signs is not None:
            way, new, e, logit, place = signs
            p = 1 / (1 + math.exp(-belief))
            still = p * math.exp(-way / model.lost_m)
            now = still - (1 - p) * math.expm1(-way / FOUND_M)
            model.drive(way, still / now)
            belief = math.log(now / (1 - now))
            if new > 0:
                belief += min(max(model.hear(new, e, logit, place), -new * model.most), new * model.most)
            belief = min(max(belief, -MOST_LOG_ODDS), MOST_LOG_ODDS)
        yield share / (1 + math.exp(-belief)), right


def loss_of(pairs):
    total, count, brier = 0.0, 0, 0.0
    for p, right in pairs:
        q = min(max(p, LEAST), 1 - LEAST)
        total -= math.log(q if right else 1 - q)
        brier += (p - right) ** 2
        count += 1
    return total / max(count, 1), brier / max(count, 1)


def of_model(kind, params, trials):
    return loss_of(pair for _, begin, steps in trials
                   for pair in stated(kind(params), begin, steps))


def fit(kind, numbers, trials):
    best = [start for _, start, _, _ in numbers]
    steps = [step for _, _, step, _ in numbers]
    least = of_model(kind, best, trials)[0]
    while max(steps) > 0.03:
        for i, (_, _, _, lowest) in enumerate(numbers):
            for sign in (1, -1):
                tried = list(best)
                tried[i] += sign * steps[i]
                value = of_model(kind, tried, trials)[0] if tried[i] >= lowest else math.inf
                if value < least:
                    best, least = tried, value
                    steps[i] *= 1.5
                    break
            else:
                steps[i] *= 0.5
    return best


def main():
    for method, kind, numbers in (("mcl", Beams, BEAMS), ("ours", Registered, REGISTERED)):
        trials = [trial for path in sys.argv[1:] for trial in read(path, method)]
        if not trials:
            continue
        best = fit(kind, numbers, trials)
        print(method, " ".join(f"{name} {value:.2f}"
                               for (name, _, _, _), value in zip(numbers, best)))
        for name in sorted({trial[0] for trial in trials}) + ["all"]:
            some = [trial for trial in trials if name in ("all", trial[0])]
            was = loss_of((p, right) for _, _, steps in some for _, _, right, p, _ in steps)
            now = of_model(kind, best, some)
            rate = sum(s[2] for t in some for s in t[2]) / sum(len(t[2]) for t in some)
            print(f"  {name:15s} right {rate:.2f}  loss {was[0]:.3f} -> {now[0]:.3f}  "
                  f"Brier {was[1]:.3f} -> {now[1]:.3f}")


if __name__ == "__main__":
    main()
