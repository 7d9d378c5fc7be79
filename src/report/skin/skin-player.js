"use strict";
// Playback of the maps. The slider and the plots' cursor show the playback time.

/// The time range and cursor of all plots; the maps show the time of the cursor.
class SkinView extends View {
    drawCursor() {
        super.drawCursor();
        if (this.cursor !== null) this.onMove(this.cursor);
    }

    /// Called with the cursor's time (s).
    onMove() {}
}

class Player {
    /// `frame`: length of a frame of the maps, s. `at(id)` returns an element of the page.
    constructor(view, frame, at) {
        Object.assign(this, {view, frame, playing: false, button: at("play"), slider: at("time"), speed: at("speed"), loop: at("loop")});
        this.button.onclick = () => this.toggle();
        this.slider.oninput = () => { this.stop(); this.view.point(this.timeOf(Number(this.slider.value))); };
        matchMedia("(prefers-reduced-motion: reduce)").matches && (this.loop.checked = false);
    }

    /// Call it when the view has its time range. A step of the slider is a frame. At the default speed, playback of the recording takes about 8 s.
    start() {
        const {begin, end} = this.view, ideal = (end - begin) / 8, decades = [];
        this.slider.max = Math.max(1, Math.ceil((end - begin) / this.frame - 1e-9) - 1);
        for (let p = -4; p <= 3; ++p) decades.push(...[1, 2, 5].map((m) => Number((m * 10 ** p).toPrecision(3))));
        const nearest = decades.reduce((best, s) => (Math.abs(Math.log(s / ideal)) < Math.abs(Math.log(best / ideal)) ? s : best));
        const shown = decades.filter((s) => (s > nearest / 30 && s < nearest * 30) || s === 1);
        this.speed.innerHTML = shown.map((s) => `<option value="${s}" ${s === nearest ? "selected" : ""}>× ${s}</option>`).join("");
    }

    /// The time (s) in the middle of frame number `step`, from 0.
    timeOf(step) { return this.view.begin + (step + 0.5) * this.frame; }

    /// Moves the slider to a time.
    follow(t) {
        this.slider.value = Math.floor((t - this.view.begin) / this.frame + 1e-9);
        this.slider.setAttribute("aria-valuetext", timeText(t, this.frame / 2));
    }

    toggle() { this.playing ? this.stop() : this.play(); }

    play() {
        const {a, b, cursor} = this.view;
        this.playing = true;
        this.time = cursor !== null && cursor >= a && cursor < b - this.frame ? cursor : a;
        this.before = null;  // time of the last screen frame, ms
        this.show();
        requestAnimationFrame((now) => this.step(now));
    }

    stop() {
        this.playing = false;
        this.show();
    }

    /// Shows on the button what it does next.
    show() {
        this.button.textContent = this.playing ? "❚❚" : "▶";
        const name = this.playing ? "Pause" : "Play";
        this.button.setAttribute("aria-label", name);
        this.button.title = `${name} (space)`;
    }

    /// Draws one screen frame at browser time `now` (ms). Plays the visible time range of the plots.
    step(now) {
        if (!this.playing) return;
        const {a, b} = this.view;
        if (this.before !== null) this.time += Math.min(0.2, (now - this.before) / 1000) * Number(this.speed.value);
        this.before = now;
        if (this.time >= b || this.time < a) {
            if (!this.loop.checked && this.time >= b) return this.view.point(b - 1e-9 * (b - a)), this.stop();
            this.time = a;
        }
        this.view.point(this.time);
        requestAnimationFrame((next) => this.step(next));
    }

    /// Stops, and moves the cursor by this number of frames, forward or (if negative) back.
    nudge(frames) {
        this.stop();
        const {cursor, begin} = this.view;
        const step = Math.floor(((cursor === null ? begin : cursor) - begin) / this.frame + 1e-9);
        this.view.point(this.timeOf(Math.max(0, Math.min(Number(this.slider.max), step + frames))));
    }
}
