// Playback: moves the cursor of a view through its visible range.

import {chooser, h} from "../base/dom";
import {fixedText} from "../base/text";
import type {View} from "../plot/view";

const SECONDS = 8;  // that playback of the recording takes at the speed that is chosen first

export class Player {
    isPlaying = false;
    readonly root: HTMLElement;
    private button = h("button", {type: "button", id: "play", onclick: () => this.toggle()});
    private slider: HTMLInputElement;
    private loop = h("input", {type: "checkbox", id: "loop", checked: !matchMedia("(prefers-reduced-motion: reduce)").matches});
    private speed = 1;
    private time = 0;
    private last: number | null = null;  // time of the last frame of the screen, ms

    /// `step`: duration (s) of a step of the slider and of the step buttons. The view must have its limits.
    constructor(private view: View, private step: number) {
        const {begin, end} = view, speeds = speedsAround((end - begin) / SECONDS);
        this.slider = h("input", {type: "range", id: "time", min: 0, max: this.steps, step: 1, value: 0, "aria-label": "time", oninput: () => this.seek(Number(this.slider.value))});
        this.speed = speeds.first;
        const button = (id: string, text: string, name: string, title: string, act: () => void) => h("button", {type: "button", id, title, "aria-label": name, onclick: act}, text);
        const speed = chooser("Speed", speeds.all.map((one) => `× ${one}`), speeds.all.indexOf(speeds.first), (k) => { this.speed = speeds.all[k]; });
        speed.id = "speed";
        this.root = h("div", {class: "toolbar player", role: "toolbar", "aria-label": "player"},
            h("span", {class: "buttons"}, this.button, button("step-back", "❙◀", "One step back", "One step back (,)", () => this.nudge(-1)), button("step-forward", "▶❙", "One step forward", "One step forward (.)", () => this.nudge(1))),
            this.slider, speed, h("label", {title: "Restart at the end"}, this.loop, " Loop"));
        this.showState();
        view.onCursor(() => this.follow());
        document.addEventListener("keydown", (event) => this.key(event));
    }

    private get steps() { return Math.max(1, Math.ceil((this.view.end - this.view.begin) / this.step - 1e-9) - 1); }
    /// The time at which a step begins.
    private timeOf(step: number) { return this.view.begin + step * this.step; }
    private get currentStep() { return Math.floor(((this.view.cursor ?? this.view.begin) - this.view.begin) / this.step + 1e-6); }

    /// Moves the slider to the cursor.
    private follow() {
        if (this.view.cursor === null) return;
        this.slider.value = String(this.currentStep);
        this.slider.setAttribute("aria-valuetext", fixedText(this.view.cursor, this.step / 10));
    }

    toggle() {
        if (this.isPlaying) this.stop();
        else this.play();
    }

    play() {
        const {a, b, cursor} = this.view;
        [this.isPlaying, this.last] = [true, null];
        this.time = cursor !== null && cursor >= a && cursor < b - this.step ? cursor : a;
        this.showState();
        requestAnimationFrame((now) => this.advance(now));
    }

    stop() {
        this.isPlaying = false;
        this.showState();
    }

    private showState() {
        const name = this.isPlaying ? "Pause" : "Play";
        this.button.textContent = this.isPlaying ? "❚❚" : "▶";
        this.button.setAttribute("aria-label", name);
        this.button.title = `${name} (space)`;
    }

    /// One frame of the screen at browser time `now` (ms).
    private advance(now: number) {
        if (!this.isPlaying) return;
        const {a, b} = this.view;
        if (this.last !== null) this.time += Math.min(0.2, (now - this.last) / 1000) * this.speed;
        this.last = now;
        if (this.time >= b && !this.loop.checked) {
            this.view.point(b);
            this.stop();
            return;
        }
        if (this.time >= b || this.time < a) this.time = a;
        this.view.point(this.time);
        requestAnimationFrame((next) => this.advance(next));
    }

    private seek(step: number) {
        this.stop();
        this.view.point(this.timeOf(step));
    }

    nudge(steps: number) { this.seek(Math.max(0, Math.min(this.steps, this.currentStep + steps))); }

    /// Space plays or pauses; comma and full stop step back or forward.
    private key(event: KeyboardEvent) {
        const act = ({" ": () => this.toggle(), ",": () => this.nudge(-1), ".": () => this.nudge(1)} as Record<string, () => void>)[event.key];
        if (!act || event.ctrlKey || event.altKey || event.metaKey || (event.target as Element).closest("select, button, summary, textarea, input[type=text]")) return;
        event.preventDefault();
        act();
    }
}

/// Speeds 1, 2, 5 ... around the ideal one, always with 1.
function speedsAround(ideal: number): {all: number[]; first: number} {
    const decades: number[] = [];
    for (let p = -4; p <= 3; ++p) decades.push(...[1, 2, 5].map((m) => Number((m * 10 ** p).toPrecision(3))));
    const distance = (speed: number) => Math.abs(Math.log(speed / ideal)), first = decades.reduce((best, one) => (distance(one) < distance(best) ? one : best));
    return {all: decades.filter((one) => (one > first / 120 && one < first * 12) || one === 1), first};
}
