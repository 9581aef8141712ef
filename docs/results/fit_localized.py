#!/usr/bin/env python3
"""Fits the numbers of LocalizedParams (filter/localized_belief.hpp) to runs of `sketchloc ablate
--suite robust` made without challengers: least log loss of the stated probability over all steps.

    sketchloc ablate --suite robust --seed 501 --methods mcl ours --drives.drawings 1 \
        --filter.localizer.challengers.count 0 --out OUT
    docs/results/fit_localized.py OUT/trials.jsonl

The contradiction at which a robot counts as carried is not fitted: simulated drives have at most 0.05 and carried
robots 0.2 and more, so that anything between fits.

Coordinate descent with shrinking steps; no packages needed. Prints the loss of what the runs stated
too. The runs must be on other buildings than those that anything is judged on.
"""
import json
import math
import sys

RIGHT_M, RIGHT_RAD = 2.0, 0.5236
NAMES = ["bias", "evidence", "inlier", "log lost_way_m", "log found_way_m", "max_ratio",
         "carried_contradiction", "log carried_slope"]
LEAST = 1e-3


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
                signs = (signs[0], signs[1], signs[2], log_odds(0.5 if signs[3] is None else signs[3]))
            steps.append((signs, errors["share_within_bounds"][i], right,
                          errors["localized_probability"][i], errors["contradiction"][i]))
        start = -6.0 if trial["start"] == "anywhere" else 4.0
        trials.append((trial["kind"], start, steps))
    return trials


def stated(params, start, steps):
    bias, evidence, inlier, lost, found, most, carried, slope = params
    lost_m, found_m, slope = math.exp(lost), math.exp(found), math.exp(slope)
    belief = start
    for signs, share, right, _, contradiction in steps:
        stayed = 1 / (1 + math.exp(min(slope * (contradiction - carried), 700.0)))
        p = stayed / (1 + math.exp(-belief))
        belief = max(math.log(max(p, 1e-12) / (1 - p)), -20.0)
        if signs is not None:
            way, new, e, logit = signs
            p = 1 / (1 + math.exp(-belief))
            to_lost, to_right = -math.expm1(-way / lost_m), -math.expm1(-way / found_m)
            now = p * (1 - to_lost) + (1 - p) * to_right
            ratio = bias + evidence * e + inlier * logit
            belief = math.log(now / (1 - now)) + new * min(max(ratio, -most), most)
            belief = min(max(belief, -20.0), 20.0)
        yield share / (1 + math.exp(-belief)), right


def loss_of(pairs):
    total, count, brier = 0.0, 0, 0.0
    for p, right in pairs:
        q = min(max(p, LEAST), 1 - LEAST)
        total -= math.log(q if right else 1 - q)
        brier += (p - right) ** 2
        count += 1
    return total / max(count, 1), brier / max(count, 1)


def fit(trials, free, start):
    def loss(params):
        if params[5] <= 0 or params[3] < 1.0 or params[4] < 1.0:
            return math.inf
        return loss_of(pair for _, begin, steps in trials for pair in stated(params, begin, steps))[0]

    best, least = list(start), loss(start)
    steps = [1.0] * 6 + [0.05, 1.0]
    while max(steps[i] for i in free) > 0.02:
        for i in free:
            for sign in (1, -1):
                tried = list(best)
                tried[i] += sign * steps[i]
                value = loss(tried)
                if value < least:
                    best, least = tried, value
                    steps[i] *= 1.5
                    break
            else:
                steps[i] *= 0.5
    return best, least


def main():
    for method, free in (("mcl", [0, 1, 3, 4, 5]), ("ours", [0, 1, 2, 3, 4, 5])):
        trials = [trial for path in sys.argv[1:] for trial in read(path, method)]
        if not trials:
            continue
        best, _ = fit(trials, free, [0.0, 0.0, 0.0, 5.0, 5.0, 3.0, 0.15, 4.6])
        print(method, " ".join(f"{name} {value:.2f}" for name, value in zip(NAMES, best)))
        for kind in sorted({trial[0] for trial in trials}) + ["all"]:
            some = [trial for trial in trials if kind in ("all", trial[0])]
            was = loss_of((p, right) for _, _, steps in some for _, _, right, p, _ in steps)
            now = loss_of(pair for _, begin, steps in some for pair in stated(best, begin, steps))
            rate = sum(s[2] for t in some for s in t[2]) / sum(len(t[2]) for t in some)
            print(f"  {kind:15s} right {rate:.2f}  loss {was[0]:.3f} -> {now[0]:.3f}  "
                  f"Brier {was[1]:.3f} -> {now[1]:.3f}")


if __name__ == "__main__":
    main()
