"""Objects of Neo, a library of electrophysiology."""

import numpy as np

from . import _corpuscle


def _libraries():
    try:
        import neo
        import quantities
    except ImportError:
        raise ImportError("neo is not installed; on Debian type: apt-get install python3-neo") from None
    return neo, quantities


def _train(neo, response, k, stop):
    models = response.models[k]
    notes = {"afferent": response.names[k], "afferent_type": response.types[k], "channel": response.channels[k],
             **{name: value for name, value in models.items() if name not in ("afferent", "afferent_type", "channel")}}
    x, y = response.positions[k]
    if not np.isnan(x):
        notes["x_m"], notes["y_m"] = float(x), float(y)
    start = min([response.start, *response.train(k)[:1]])
    return neo.SpikeTrain(response.train(k), units="s", t_start=start, t_stop=stop, name=response.label(k), **notes)


def block_of(response, trials):
    """The Block of a response."""
    neo, quantities = _libraries()
    from ._nwb import force_of
    from ._trials import trials_of
    trials = trials_of(trials)
    force = force_of(response)
    segment = neo.Segment(name=force.name)
    end = response.start + response.duration
    stop = max([end, *response.times.max(initial=end, keepdims=True)])  # a nerve fibre conducts spikes after the end of the force
    segment.spiketrains.extend([_train(neo, response, k, stop) for k in range(len(response.names))])  # not a generator, which Neo ignores
    samples = force.samples.reshape(len(force.samples), -1)
    segment.analogsignals.append(neo.AnalogSignal(samples, units="N", sampling_rate=force.rate * quantities.Hz, t_start=force.start * quantities.s,
                                                  name=force.name, array_annotations={"channel_names": np.array(force.channels)}))
    if trials:
        start, end, labels = zip(*trials)
        segment.epochs.append(neo.Epoch(times=np.array(start) * quantities.s, durations=(np.array(end) - np.array(start)) * quantities.s,
                                        labels=np.array(labels), name="trials"))
    block = neo.Block(name="corpuscle")
    block.segments.append(segment)
    return block


def force_of(cls, signal):
    """A Force of class `cls` of an AnalogSignal."""
    neo, _ = _libraries()
    if not isinstance(signal, neo.AnalogSignal):
        raise _corpuscle.InputError(f"from_neo: a neo.AnalogSignal is expected, not {type(signal).__name__}")
    try:
        newtons = signal.rescale("N")
    except ValueError:
        raise _corpuscle.InputError(f"from_neo: the signal is in {signal.dimensionality.string}, which is not a unit of force") from None
    names = signal.array_annotations.get("channel_names")
    samples = np.asarray(newtons.magnitude, dtype=np.float64)
    return cls(samples[:, 0] if samples.shape[1] == 1 else samples, float(signal.sampling_rate.rescale("Hz")), None if names is None else [str(n) for n in names],
               float(signal.t_start.rescale("s")), signal.name or "force")
