// Spikes as clicks, as an electrode in the nerve would let one hear them.

const MOST_CLICKS = 300;  // per second; more cannot be told apart

export class Sound {
    private context: AudioContext | null = null;
    private click: AudioBuffer | null = null;
    private last = 0;  // time of the last click

    get isOn() { return this.context !== null && this.context.state === "running"; }

    /// Must be called by a click or a key, because browsers allow no sound before.
    async toggle(): Promise<boolean> {
        if (!this.context) this.context = new AudioContext();
        else if (this.context.state === "running") {
            await this.context.suspend();
            return false;
        }
        await this.context.resume();
        this.click = this.click || clickOf(this.context);
        return true;
    }

    /// Plays spikes at times (s) of the simulation, `now` being heard at once.
    play(times: number[], now: number) {
        if (!this.isOn) return;
        const {context} = this;
        for (const t of times) {
            const at = Math.max(context!.currentTime, context!.currentTime + 0.03 + t - now);
            if (at - this.last < 1 / MOST_CLICKS) continue;
            this.last = at;
            const source = context!.createBufferSource();
            source.buffer = this.click;
            source.connect(context!.destination);
            source.start(at);
        }
    }
}

/// A short decaying oscillation.
function clickOf(context: AudioContext): AudioBuffer {
    const buffer = context.createBuffer(1, Math.ceil(0.004 * context.sampleRate), context.sampleRate), values = buffer.getChannelData(0);
    for (let k = 0; k < values.length; ++k) {
        const t = k / context.sampleRate;
        values[k] = 0.3 * Math.exp(-t / 0.0008) * Math.sin(2 * Math.PI * 1500 * t);
    }
    return buffer;
}
