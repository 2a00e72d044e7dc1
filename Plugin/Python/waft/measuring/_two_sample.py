# SPDX-License-Identifier: BSD-3-Clause
"""Two-sample AUC of motion and drifters: a classifier on windows of one second of free flight."""
import numpy as np

from waft.measuring._flights import stretches

SECONDS = 1.0
FOLDS = 5
LEAST_WINDOWS = 40  # of either kind


def windows(airs):
    """(features [window, feature], group [window]) of all windows of free flight, a third of a second apart; the group is the path,
    which no other air has."""
    features, groups = [], []
    base = 0
    for air in airs:
        length, stride = int(round(SECONDS * air.rate)), max(int(round(SECONDS * air.rate / 3.0)), 1)
        places = [(body, begin) for body, first, last in stretches(air.free)
                  for begin in range(first, last - length + 1, stride)]
        if places:
            bodies, begins = np.array(places).T
            frames = begins[:, None] + np.arange(length)
            parts = (array[bodies[:, None], frames] for array in (air.velocity, air.acceleration, air.jerk))
            features.append(_features(*parts, air.rate))
            groups.append(base + bodies)
        base += len(air)
    return (np.concatenate(features), np.concatenate(groups)) if features else (np.zeros((0, 1)), np.zeros(0, int))


def _features(v, a, jerk, rate):
    """Of windows [window, frame, 3]; a steady drift changes none of them."""
    tiny = 1e-12
    sway = v - v.mean(axis=1, keepdims=True)
    size, roughness = np.linalg.norm(a, axis=2), np.linalg.norm(jerk, axis=2)
    power = np.sum(a**2, axis=(1, 2)) + tiny
    columns = [*np.quantile(size, (0.1, 0.5, 0.9), axis=1), *np.quantile(roughness, (0.1, 0.5, 0.9), axis=1)]
    for seconds in (0.1, 0.2, 1.0 / 3.0):
        lag = max(int(round(seconds * rate)), 1)
        columns.append(np.sum(a[:, lag:] * a[:, :-lag], axis=(1, 2)) / power)
    columns += [np.sqrt(np.mean(np.sum(sway[..., :2] ** 2, axis=2), axis=1)), np.sqrt(np.mean(sway[..., 2] ** 2, axis=1))]
    waves = np.abs(np.fft.rfft(a * np.hanning(a.shape[1])[None, :, None], axis=1)) ** 2
    frequencies = np.fft.rfftfreq(a.shape[1], 1.0 / rate)
    density = waves.sum(axis=2)
    columns.append(density @ frequencies / (density.sum(axis=1) + tiny))
    lag = max(int(round(0.1 * rate)), 1)
    along = np.sum(a[:, lag:] * a[:, :-lag], axis=2) / (size[:, lag:] * size[:, :-lag] + tiny)
    columns.append(np.mean(np.arccos(np.clip(along, -1.0, 1.0)), axis=1))
    columns.append(np.mean(np.sum(a * sway, axis=2) ** 2 / (size**2 * np.sum(sway**2, axis=2) + tiny), axis=1))
    columns.append(np.sqrt(np.sum(a[..., 2] ** 2, axis=1) / (np.sum(a[..., :2] ** 2, axis=(1, 2)) + tiny)))
    return np.stack(columns, axis=1)


def is_there():
    try:
        import sklearn.ensemble  # noqa: F401
    except ImportError:
        return False
    return True


def area(airs, others):
    """Area under the curve of the receiver's operating characteristic: 0.5 where the two cannot be told apart, 1 where always; NaN
    where windows are few. Folds are of whole paths."""
    from sklearn.ensemble import HistGradientBoostingClassifier
    from sklearn.metrics import roc_auc_score
    from sklearn.model_selection import StratifiedGroupKFold
    from threadpoolctl import threadpool_limits

    (own, own_groups), (their, their_groups) = windows(airs), windows(others)
    if min(len(own), len(their)) < LEAST_WINDOWS:
        return float("nan")
    values = np.concatenate([own, their])
    kind = np.repeat([1, 0], [len(own), len(their)])
    group = np.concatenate([own_groups, own_groups.max() + 1 + their_groups])
    if min(len(np.unique(own_groups)), len(np.unique(their_groups))) < FOLDS:
        return float("nan")
    guess = np.zeros(len(kind))
    for learnt, held in StratifiedGroupKFold(FOLDS, shuffle=True, random_state=0).split(values, kind, group):
        weight = np.where(kind[learnt] == 1, 0.5 / np.mean(kind[learnt]), 0.5 / np.mean(1 - kind[learnt]))
        trees = HistGradientBoostingClassifier(random_state=0, max_iter=50, learning_rate=0.1)
        with threadpool_limits(1):  # threads that wait for each other take longer than one alone
            trees.fit(values[learnt], kind[learnt], sample_weight=weight)
            guess[held] = trees.predict_proba(values[held])[:, 1]
    return float(roc_auc_score(kind, guess))
