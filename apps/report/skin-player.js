"use strict";
// Time on the maps: it plays, follows the slider, and is the cursor of the plots.

/// The window and cursor of all plots; maps follow the cursor.
class SkinView extends View {
    drawCursor() {
        super.drawCursor();
        if (this.cursor !== null) this.moved(this.cursor);
    }

    moved() {}
}

class Player {
    /// `at(id)` finds the page's controls.
    constructor(view, frame, at) {
        Object.assign(this, {view, frame, playing: false, button: at("play"), slider: at("time"), speed: at("speed"), again: at("again")});
        this.button.onclick = () => this.toggle();
        this.slider.oninput = () => { this.stop(); this.view.point(this.timeOf(Number(this.slider.value))); };
        matchMedia("(prefers-reduced-motion: reduce)").matches && (this.again.checked = false);
    }

    /// Once the view has its window: the slider's steps are frames, the speeds such that the whole lasts some seconds.
    start() {
        const {begin, end} = this.view, fit = (end - begin) / 8, decades = [];
        this.slider.max = Math.max(1, Math.ceil((end - begin) / this.frame - 1e-9) - 1);
        for (let p = -4; p <= 3; ++p) decades.push(...[1, 2, 5].map((m) => Number((m * 10 ** p).toPrecision(3))));
        const nearest = decades.reduce((best, s) => (Math.abs(Math.log(s / fit)) < Math.abs(Math.log(best / fit)) ? s : best));
        const shown = decades.filter((s) => (s > nearest / 30 && s < nearest * 30) || s === 1);
        this.speed.innerHTML = shown.map((s) => `<option value="${s}" ${s === nearest ? "selected" : ""}>× ${s}</option>`).join("");
    }

    timeOf(step) { return this.view.begin + (step + 0.5) * this.frame; }

    /// What the slider says, for a time.
    follow(t) {
        this.slider.value = Math.floor((t - this.view.begin) / this.frame + 1e-9);
        this.slider.setAttribute("aria-valuetext", timeText(t, this.frame / 2));
    }

    toggle() { this.playing ? this.stop() : this.play(); }

    play() {
        const {a, b, cursor} = this.view;
        this.playing = true;
        this.time = cursor !== null && cursor >= a && cursor < b - this.frame ? cursor : a;
        this.before = null;
        this.show();
        requestAnimationFrame((now) => this.step(now));
    }

    stop() {
        this.playing = false;
        this.show();
    }

    show() {
        this.button.textContent = this.playing ? "❚❚" : "▶";
        const name = this.playing ? "pause" : "play";
        this.button.setAttribute("aria-label", name);
        this.button.title = `${name} (space)`;
    }

    /// From one frame of the screen to the next; plays what the plots show.
    step(now) {
        if (!this.playing) return;
        const {a, b} = this.view;
        if (this.before !== null) this.time += Math.min(0.2, (now - this.before) / 1000) * Number(this.speed.value);
        this.before = now;
        if (this.time >= b || this.time < a) {
            if (!this.again.checked && this.time >= b) return this.view.point(b - 1e-9 * (b - a)), this.stop();
            this.time = a;
        }
        this.view.point(this.time);
        requestAnimationFrame((next) => this.step(next));
    }

    /// One frame on or back.
    nudge(frames) {
        this.stop();
        const {cursor, begin} = this.view;
        const step = Math.floor(((cursor === null ? begin : cursor) - begin) / this.frame + 1e-9);
        this.view.point(this.timeOf(Math.max(0, Math.min(Number(this.slider.max), step + frames))));
    }
}
