// The simulation behind the page: what was started, and the history of its force, spikes and probes.

import {NumberArray, numberedArrays} from "../base/arrays";
import {variantColour} from "../base/colours";
import {shortest} from "../base/text";
import type {Catalogue, Parameter} from "./catalogue";
import type {Answer, Engine} from "./engine";
import {HISTORY, LiveCurve, LiveTrain, appendSpikes} from "./history";
import type {Press} from "./press";
import {Settings, settingTexts} from "./settings";

export interface ValidRange { quantity: string; unit: string; low: number; high: number; meaning: string }

/// The sentence about a quantity that has left its range.
export const rangeText = ({quantity, unit, low, high, meaning}: ValidRange) => `${quantity} is outside ${shortest(low)} to ${shortest(high)} ${unit}: ${meaning}`;

interface RowInfo {
    name: string; class: string; composition: string; is_circuit: boolean; probes: {name: string; unit: string}[]; delay: number; parameters: Parameter[];
    ranges: ValidRange[];
}

export interface Row { info: RowInfo; colour: string; train: LiveTrain; curves: LiveCurve[]; power: number; error: string; outside: string }  // outside: the range that the last block has left
export interface SkinClass { name: string; afferent: string; first: number; count: number }

export interface Skin {
    population: string; classes: SkinClass[]; site_side: number;
    x: number; y: number;                              ///< where the contact is in the beginning, m
    unitX: Float32Array; unitY: Float32Array;          ///< of the afferents, m
    siteX: Float32Array; siteY: Float32Array;          ///< m
    outline: Float32Array[]; borders: Float32Array[];  ///< polygons x, y, x, y ... in m
    trains: LiveTrain[];
}

const PROBE_RATE = 1000;     // values of a probe per second
const MOST_PENDING = 2;
const SLICE = 0.03;          // s for which the engine computes a job before it answers
const LONGEST_BLOCK = 0.05;  // s; if the engine needs longer, the simulation is slower than real time

export class Session {
    rows: Row[] = [];
    skin: Skin | null = null;
    force = new LiveCurve("force", "N", 1 / PROBE_RATE);  // of each sample
    time = 0;       // simulated since the start, s
    changes = 0;    // of the data: starts and answers
    speed = 1;      // simulated seconds per second, over about the last second
    contactRadius = 0;  // m
    contactValues = new Map<string, number>();  // of the parameters that can be set for the indenter, SI
    isPaused = false;
    warnings: string[] = [];
    formats: string[] = [];  // in which the engine saves spikes
    newSpikes: (times: number[]) => void = () => {};  // called with the times (s) of new spikes of rows
    private pending = 0;     // blocks that the engine has not answered yet; two keep it busy while an answer is drawn
    private lastAnswer = 0;  // its time, ms
    private simulated = 0;   // recently simulated, s
    private computed = 0;    // s that the engine needed for it
    private starts = 0;      // requested, and not answered yet
    private rowChanges = 0;  // requested, and not answered yet
    private contactChanges = 0;  // requested, and not answered yet: the contact may have a shear of its own
    private rate = 1;        // samples per second
    private job = 0;         // number of the newest one
    private generation = 0;  // answers to a start that has been replaced are ignored
    private lastFrame = 0;
    private due = 0;         // s of simulation that are not requested yet

    /// `failed`: called with the sentence of an error of the engine, and with "" when a change was accepted.
    constructor(readonly engine: Engine, readonly catalogue: Catalogue, public settings: Settings, private press: Press, private failed: (text: string) => void) {}

    /// Starts the simulation of the settings. Returns false, and keeps the one before, if the engine refuses.
    async start(): Promise<boolean> {
        const {rate, seed, rows, population, indenter, contact} = this.settings;
        const request = {request: "start", rate, seed, rows: rows.map(({afferent, set}) => ({afferent, set: settingTexts(set)})),
                         ...(population ? {skin: {population, indenter, contact: settingTexts(contact)}} : {})};
        ++this.starts;
        try {
            const {head, arrays} = await this.engine.request(request);
            ++this.generation;
            ++this.changes;
            this.rows = head.rows.map((info: RowInfo, k: number) => this.emptyRow(info, variantColour(info.class, head.rows.slice(0, k).filter((one: RowInfo) => one.class === info.class).length)));
            this.skin = head.skin ? skinOf(head.skin, arrays) : null;
            this.force = new LiveCurve("force", "N", 1 / rate);
            [this.rate, this.isPaused] = [rate, false];
            this.setContactValues(head.skin);
            [this.time, this.due, this.warnings, this.contactRadius, this.formats] = [0, 0, head.warnings || [], 0, head.formats];
            return true;
        } catch (error) {
            this.failed((error as Error).message);
            return false;
        } finally {
            --this.starts;
        }
    }

    private emptyRow(info: RowInfo, colour: string): Row {
        const T = this.every / this.settings.rate;
        return {info, colour, train: new LiveTrain(), power: 0, error: "", outside: "", curves: info.probes.map(({name, unit}) => new LiveCurve(name, unit, T, info.name))};
    }

    private get every() { return Math.max(1, Math.round(this.settings.rate / PROBE_RATE)); }

    /// Replaces the settings of a row while the simulation goes on.
    async setRow(k: number): Promise<boolean> {
        ++this.rowChanges;
        try {
            const {head} = await this.engine.request({request: "set", row: k, set: settingTexts(this.settings.rows[k].set)});
            this.rows[k].info = head.row;
            this.rows[k].error = "";
            this.failed("");
            return true;
        } catch (error) {
            this.failed((error as Error).message);
            return false;
        } finally {
            --this.rowChanges;
        }
    }

    /// Replaces the indenter while the simulation goes on. Returns false if the engine refuses.
    async setContact(): Promise<boolean> {
        const {indenter, contact} = this.settings;
        ++this.contactChanges;
        try {
            const {head} = await this.engine.request({request: "contact", indenter, set: settingTexts(contact)});
            this.setContactValues(head);
            this.failed("");
            return true;
        } catch (error) {
            this.failed((error as Error).message);
            return false;
        } finally {
            --this.contactChanges;
        }
    }

    private setContactValues(head: {contact_parameters: {name: string; value: number}[]} | undefined) {
        this.contactValues = new Map((head ? head.contact_parameters : []).map(({name, value}) => [name, value]));
    }

    /// Simulates a complete force: sends a request, and `continue` until it is done; `each` gets the answers. It returns false if a newer job has
    /// replaced this one, or if `each` has returned false, which cancels it.
    async runJob(head: object, arrays: Record<string, NumberArray>, each: (answer: Answer) => boolean | void): Promise<boolean> {
        const job = ++this.job;
        let answer = await this.engine.request({...head, slice: SLICE}, arrays);
        for (;;) {
            if (job !== this.job) return false;
            const isWanted = each(answer) !== false;
            if (answer.head.done) return true;
            if (!isWanted) {
                this.cancelJob();
                return false;
            }
            answer = await this.engine.request({request: "continue", slice: SLICE});
        }
    }

    cancelJob() {
        ++this.job;
        this.engine.request({request: "cancel"}).catch((error: Error) => this.failed(error.message));
    }

    /// Called at each screen frame with its time (s): requests the samples since the last one, unless the engine has two blocks to do.
    frame(now: number) {
        const passed = Math.min(now - this.lastFrame, 0.25);
        this.lastFrame = now;
        if (this.isPaused || this.starts > 0 || this.generation === 0) return;
        this.due = Math.min(this.due + passed, LONGEST_BLOCK);
        const samples = Math.floor(this.due * this.rate);
        if (this.pending === MOST_PENDING || samples === 0) return;
        this.due -= samples / this.rate;
        void this.advance(samples);
    }

    /// The force of the last minute: of each sample from number `first` on, N.
    recentForce(): {first: number; values: Float64Array} {
        const {clock: {T, samples}} = this.force, first = Math.max(0, samples - Math.round(HISTORY / T));
        return {first, values: Float64Array.from({length: samples - first}, (_, k) => this.force.range(first + k, first + k + 1)[0] ?? 0)};
    }

    /// True if the contact itself has a tangential force, so that the press must not add one.
    get hasOwnShear() { return ["tilt", "friction"].some((name) => (this.contactValues.get(name) || 0) > 0); }

    /// True if nothing has fired since the start.
    get isSilent() { return [...this.rows.map(({train}) => train), ...(this.skin ? this.skin.trains : [])].every(({count}) => count === 0); }

    get isBusy() { return this.pending > 0; }

    /// True until the engine has answered all starts and changes of settings.
    get isChanging() { return this.starts + this.rowChanges + this.contactChanges > 0; }

    private async advance(samples: number) {
        const {generation} = this, asked = performance.now(), {rate} = this, {force, ...place} = this.press.block(samples, rate, this.hasOwnShear || this.contactChanges > 0);
        ++this.pending;
        try {
            const {head, arrays} = await this.engine.request({request: "advance", samples, every: this.every}, this.skin ? {force, ...place} : {force});
            if (generation === this.generation) this.append(head, arrays, force);
        } catch (error) {
            this.isPaused = true;
            this.failed((error as Error).message);
        }
        --this.pending;
        const now = performance.now(), seconds = (now - Math.max(asked, this.lastAnswer)) / 1000;
        this.lastAnswer = now;
        [this.simulated, this.computed] = [0.95 * this.simulated + samples / rate, 0.95 * this.computed + seconds];
        this.speed = Math.min(99, this.simulated / Math.max(this.computed, 1e-4));
    }

    private append(head: any, arrays: Record<string, NumberArray>, force: Float64Array) {
        ++this.changes;
        this.time = head.to / this.rate;
        this.force.append(force, head.from / this.rate);
        appendSpikes([...this.rows.map(({train}) => train), ...(this.skin ? this.skin.trains : [])], arrays.unit, arrays.time);
        this.newSpikes(Array.from(arrays.time || []).filter((_, k) => arrays.unit[k] < this.rows.length));
        head.rows.forEach((one: any, r: number) => {
            const row = this.rows[r];
            [row.power, row.error] = [one.power || 0, one.error || row.error];
            const left = row.info.ranges.find((_, k) => one.outside[k] > 0);
            row.outside = left ? rangeText(left) : "";
            row.curves.forEach((curve, p) => { const values = arrays[`probe.${r}.${p}`]; if (values) curve.append(values, one.first); });
        });
        if (head.contact) this.contactRadius = head.contact.radius;
        for (const train of [...this.rows.map((row) => row.train), ...(this.skin ? this.skin.trains : [])]) train.forget(this.time - HISTORY);
    }
}

/// The skin that an answer describes.
export function skinOf(head: any, arrays: Record<string, NumberArray>): Skin {
    const floats = (name: string) => arrays[name] as Float32Array;
    const trains = (head.classes as SkinClass[]).flatMap(({count}) => Array.from({length: count}, () => new LiveTrain()));
    return {...head, unitX: floats("x"), unitY: floats("y"), siteX: floats("site_x"), siteY: floats("site_y"), outline: numberedArrays(arrays, "outline"), borders: numberedArrays(arrays, "border"), trains};
}
