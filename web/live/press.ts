// The force on the skin: position and force follow the pointer, the keys or a programme, and a block of samples is made for each step of the
// simulation.

const RISE = 0.04;  // s, in which the force rises to its target, or falls to zero

/// A movement that the page makes by itself. `at` gives the place (m), and the fraction of the force, at time t (s) after its start.
interface Programme { duration: number; at(t: number): {x: number; y: number; fraction: number} }

export class Press {
    isDown = false;
    x = 0;       // position on the skin, m
    y = 0;
    target = 1;  // force while it is down, N
    hasShear = false;
    force = 0;   // at the last sample, N
    private lastX = 0;
    private lastY = 0;
    private programme: Programme | null = null;
    private played = 0;  // s of the programme
    private place = [0, 0];  // where it began, and where the contact returns to

    /// Moves to a place at once; a press that is down moves there during the next block.
    moveTo(x: number, y: number) {
        [this.x, this.y] = [x, y];
        if (this.force === 0) [this.lastX, this.lastY] = [x, y];
    }

    play(programme: Programme) {
        if (!this.programme) this.place = [this.x, this.y];
        [this.programme, this.played, this.isDown] = [programme, 0, false];
    }
    stop() { this.programme = null; }

    /// Force (N), position (m) and shear (N) for the next n samples. The shear, half the force, pulls the skin along with the movement;
    /// there is none if the contact has its own.
    block(n: number, rate: number, hasOwnShear = false): Record<string, Float64Array> {
        this.endProgramme();
        const force = new Float64Array(n), x = new Float64Array(n), y = new Float64Array(n), before = [this.lastX, this.lastY];
        for (let k = 0; k < n; ++k) {
            if (this.programme && this.played < this.programme.duration) this.follow(this.programme, 1 / rate);
            else this.approach((k + 1) / n, before, 1 / rate);
            [force[k], x[k], y[k]] = [Math.fround(this.force), this.lastX, this.lastY];  // as it is kept and saved
        }
        return this.hasShear && !hasOwnShear ? {force, x, y, ...shearOf(force, [this.lastX - before[0], this.lastY - before[1]])} : {force, x, y};
    }

    private follow(programme: Programme, dt: number) {
        const {x, y, fraction} = programme.at((this.played += dt));
        [this.lastX, this.lastY, this.force] = [x, y, fraction * this.target];
        [this.x, this.y] = [x, y];
    }

    /// After a programme the contact returns to where it began.
    private endProgramme() {
        if (!this.programme || this.played < this.programme.duration) return;
        [this.programme, this.force] = [null, 0];
        this.moveTo(this.place[0], this.place[1]);
    }

    /// Moves towards the place of the pointer, which it reaches at the end of the block, and towards its force.
    private approach(fraction: number, [x, y]: number[], dt: number) {
        const goal = this.isDown ? this.target : 0, step = Math.max(this.target, this.force, 0.01) / RISE * dt;
        this.force += Math.max(-step, Math.min(step, goal - this.force));
        [this.lastX, this.lastY] = [x + (this.x - x) * fraction, y + (this.y - y) * fraction];
    }
}

function shearOf(force: Float64Array, [dx, dy]: number[]): Record<string, Float64Array> {
    const length = Math.hypot(dx, dy), part = length > 1e-6 ? 0.5 / length : 0;
    return {shear_x: force.map((f) => f * part * dx), shear_y: force.map((f) => f * part * dy)};
}

/// Rises to 1 in `rise` seconds, and falls to 0 at the end.
const envelope = (t: number, duration: number, rise: number) => Math.max(0, Math.min(1, t / rise, (duration - t) / rise));

/// A press and release at one place.
export const tap = (x: number, y: number): Programme => ({duration: 0.6, at: (t) => ({x, y, fraction: envelope(t, 0.6, RISE)})});
/// A stroke from one end of a line to the other.
export const stroke = (from: [number, number], to: [number, number], duration = 1.2): Programme => ({
    duration, at: (t) => ({x: from[0] + (to[0] - from[0]) * t / duration, y: from[1] + (to[1] - from[1]) * t / duration, fraction: envelope(t, duration, RISE)}),
});
/// A vibration of this frequency (Hz) about half the force, at one place.
export const vibration = (x: number, y: number, frequency: number, duration = 1.5): Programme => ({
    duration, at: (t) => ({x, y, fraction: envelope(t, duration, 0.1) * (0.5 + 0.1 * Math.sin(2 * Math.PI * frequency * t))}),
});
