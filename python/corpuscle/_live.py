"""A skin that runs while frames of force arrive."""

from . import _corpuscle
from ._options import count, name_of, number, real_array, settings_of


class LiveSkin:
    """Force frames in, spikes out, one frame at a time. The spikes are those of respond() for the same frames.

    - population: "hand", "fingertip", "grid 8x8", a population file, or afferents by name ("sa1,fa1") on each of `channels` channels.
    - rate: frames a second, Hz.
    - settings: {"sa1.f_B": "25 Hz"}.
    - taxels: path of a layout. A frame is then the force of each taxel.

    Raises InputError. copy and pickle keep the state.
    """

    def __init__(self, population, rate=1000.0, channels=1, settings=None, taxels=None):
        self._arguments = (name_of(population, "population"), number(rate, "rate"), count(channels, "channels", 2**32 - 1), settings_of(settings),
                           None if taxels is None else name_of(taxels, "taxels"))
        population, rate, channels, texts, taxels = self._arguments
        self._skin = (_corpuscle.LiveSkin(population, rate, channels, texts) if taxels is None
                      else _corpuscle.LiveSkin.with_taxels(population, taxels, rate, texts))

    def __getstate__(self):
        return self._arguments, self.save()

    def __setstate__(self, state):
        arguments, saved = state
        self.__init__(*arguments)
        self.resume(saved)

    @property
    def frames(self):
        """The number of frames so far."""
        return self._skin.frames

    @property
    def sites(self):
        """The number of sites."""
        return self._skin.sites

    @property
    def frame_size(self):
        """The number of forces in a frame."""
        return self._skin.frame_size

    @property
    def afferents(self):
        """The number of afferents."""
        return self._skin.afferents

    def name(self, index):
        """The name of an afferent: "sa1#17"."""
        return self._skin.afferent_name(count(index, "index", 2**32 - 1))

    def site(self, index):
        """(name, x, y) of a site; m."""
        return self._skin.site(count(index, "index", 2**32 - 1))

    def push(self, frame):
        """Simulates one frame, and returns the spikes that arrive: a list of (time in s, index of the afferent).

        frame: the force of each site or taxel, N, shape [frame_size]. Raises InputError for another size and for forces that are not finite.
        """
        return self._skin.push(real_array(frame, "frame"))

    def finish(self):
        """The spikes that are still travelling after the last frame: a list as of push()."""
        return self._skin.finish()

    def save(self):
        """The state, as bytes."""
        return self._skin.save()

    def resume(self, state):
        """Restores a saved state of a skin that was made with the same arguments. Raises InputError for other bytes."""
        if not isinstance(state, (bytes, bytearray, memoryview)):
            raise _corpuscle.InputError(f"state = {state!r} is not the bytes of save()")
        self._skin.resume(bytes(state))
