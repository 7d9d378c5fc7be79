"""Agreement of the rates of two programs over a set of stimuli, and its tables. A row is one class under one stimulus."""
import itertools

import numpy as np

PARTS = ("onset", "steady")


def correlation(x, y):
    """Pearson's; None if one side is constant."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    return None if x.size < 3 or np.ptp(x) == 0 or np.ptp(y) == 0 else float(np.corrcoef(x, y)[0, 1])


def ranks(x):
    """Ranks; equal values share the mean of theirs."""
    x = np.asarray(x)
    return np.array([(x < v).sum() + ((x == v).sum() - 1) / 2 for v in x])


def mean(values):
    return float(np.mean(values)) if values else None


def ratio(rows, quantity):
    """Sum of ours over sum of theirs; None if theirs is zero."""
    ours, theirs = (sum(row[f"{quantity}_{program}"] for row in rows) for program in ("ours", "theirs"))
    return ours / theirs if theirs else None


def of_rates(rows, part):
    ours, theirs = ([row[f"{part}_Hz_{program}"] for row in rows] for program in ("ours", "theirs"))
    return {"pearson": correlation(ours, theirs), "spearman": correlation(ranks(ours), ranks(theirs)),
            "mean_Hz_ours": mean(ours), "mean_Hz_theirs": mean(theirs)}


def without_worst(rows, part):
    """The stimulus without which the correlation is greatest, and that correlation."""
    found = [(of_rates(rows[:k] + rows[k + 1:], part)["pearson"], row["stimulus"]) for k, row in enumerate(rows)]
    return max((pair for pair in found if pair[0] is not None), default=(None, None))


def of_class(rows):
    groups = dict.fromkeys(row["group"] for row in rows)
    out = {part: of_rates(rows, part) for part in PARTS}
    for part in PARTS:
        out[part]["pearson_without"] = {g: of_rates([row for row in rows if row["group"] != g], part)["pearson"] for g in groups}
        out[part]["pearson_without_worst"], out[part]["worst"] = without_worst(rows, part)
    out["totals"] = {"ours": sum(row["total_ours"] for row in rows), "theirs": sum(row["total_theirs"] for row in rows),
                     "ratio": ratio(rows, "total")}
    out["totals_by_group"] = {g: ratio([row for row in rows if row["group"] == g], "total") for g in groups}
    return out


def order(rates):
    """The classes that fire, the fastest first."""
    return [c for c, rate in sorted(rates.items(), key=lambda pair: -pair[1]) if rate > 0]


def same_order(rows, part):
    """The fraction of pairs of classes under one stimulus, at least 1 Hz apart in TouchSim, that have the same order in both."""
    agree = []
    for _, group in itertools.groupby(rows, key=lambda row: row["stimulus"]):
        for a, b in itertools.combinations(list(group), 2):
            ours, theirs = (a[f"{part}_Hz_{program}"] - b[f"{part}_Hz_{program}"] for program in ("ours", "theirs"))
            if abs(theirs) >= 1:
                agree.append(ours * theirs > 0)
    return {"pairs": len(agree), "same": mean(agree)}


def agreement(rows, classes):
    out = {"classes": {c: of_class([row for row in rows if row["class"] == c]) for c in classes}, "order": {}}
    for part in PARTS:
        rates = {p: {c: out["classes"][c][part][f"mean_Hz_{p}"] for c in classes} for p in ("ours", "theirs")}
        out["order"][part] = {p: order(rates[p]) for p in rates} | same_order(rows, part)
    return out


def print_rates(rows, forces):
    print("mean rate (Hz) of touched afferents, and spikes per touched afferent: ours, TouchSim's; total: spikes of all afferents\n")
    print(f"{'':<26}{'class':<6}{'units':>5}{'onset Hz':>15}{'spikes':>13}{'steady Hz':>15}{'spikes':>13}{'total':>16}")
    for k, row in enumerate(rows):
        first = k == 0 or rows[k - 1]["stimulus"] != row["stimulus"]
        text = f"{row['stimulus'] if first else '':<26}{row['class']:<6}{row['touched']:>5}"
        for part in PARTS:
            text += f"{row[part + '_Hz_ours']:>8.1f}{row[part + '_Hz_theirs']:>7.1f}"
            text += f"{row[part + '_spikes_per_unit_ours']:>7.2f}{row[part + '_spikes_per_unit_theirs']:>6.2f}"
        force = forces[row["stimulus"]]
        print(f"{text}{row['total_ours']:>9.0f}{row['total_theirs']:>7.0f}"
              + (f"   {force['ours_N']:.3g} N, TouchSim's {force['theirs_N']:.3g} N" if first else ""))


def number(value, low=None, high=None):
    if value is None:
        return "-"
    missed = (low is not None and value < low) or (high is not None and value > high)
    return f"{value:.2f}" + "*" * missed


def print_correlations(classes, groups):
    print("\nmean rates over the set, and correlations over it: of all stimuli, then Pearson's without one group, and without one stimulus")
    print(f"{'class':<7}{'part':<7}{'ours Hz':>8}{'TouchSim':>9}{'Pearson':>9}{'Spearman':>9}" + "".join(f"{'- ' + g:>11}" for g in groups))
    for c, found in classes.items():
        for part in PARTS:
            r = found[part]
            print(f"{c:<7}{part:<7}{r['mean_Hz_ours']:>8.1f}{r['mean_Hz_theirs']:>9.1f}{number(r['pearson'], 0.8):>9}"
                  f"{number(r['spearman'], 0.8):>9}" + "".join(f"{number(r['pearson_without'][g], 0.8):>11}" for g in groups)
                  + f"{number(r['pearson_without_worst'], 0.8):>8} {r['worst'] or ''}".rstrip())


def print_totals(classes, groups):
    print("\ntotals, and ours over TouchSim's: of all stimuli, then of each group")
    print(f"{'class':<7}{'ours':>8}{'TouchSim':>9}{'ratio':>9}" + "".join(f"{g:>11}" for g in groups))
    for c, found in classes.items():
        t = found["totals"]
        print(f"{c:<7}{t['ours']:>8.0f}{t['theirs']:>9.0f}{number(t['ratio'], 0.5, 2):>9}"
              + "".join(f"{number(found['totals_by_group'][g], 0.5, 2):>11}" for g in groups))


def print_agreement(result):
    groups = list(next(iter(result["classes"].values()))["totals_by_group"])
    print_correlations(result["classes"], groups)
    print_totals(result["classes"], groups)
    print()
    for part, o in result["order"].items():
        print(f"order, {part}: ours {' > '.join(o['ours']) or 'none'}; TouchSim {' > '.join(o['theirs']) or 'none'}; the same in {number(o['same'])} of "
              f"{o['pairs']} pairs of classes under one stimulus")
