// The choices of the user: afferents and their settings, skin, indenter. They are kept in the link of the page.

import {linkNumber, linkValues, setLink} from "../base/link";
import type {Catalogue} from "./catalogue";

export interface RowSettings { afferent: string; set: Map<string, string> }  ///< set: "f_B" -> "25Hz"

export interface Settings {
    rate: number;        ///< samples per second
    seed: number;
    force: number;       ///< of a press, N
    rows: RowSettings[];
    population: string;  ///< "": no skin
    indenter: string;
    contact: Map<string, string>;
}

const MAX_LINK = 100_000;  // characters: all sizes of a dozen chips
export const MAX_ROWS = 12, MIN_FORCE = 0.01, MAX_FORCE = 20;  // N

export const defaultSettings = (catalogue: Catalogue): Settings => ({
    rate: 2000, seed: 0, force: 1, population: "fingertip", indenter: catalogue.indenters[0].name, contact: new Map(),
    rows: ["sa1", "sa1-nerve", "sa1-circuit", "fa1-nerve"].map((afferent) => ({afferent, set: new Map()})),
});

/// Settings as the engine takes them: ["f_B=25Hz"].
export const settingTexts = (set: Map<string, string>) => Array.from(set, ([name, value]) => `${name}=${value}`);

export const copyOf = (settings: Settings): Settings =>
    ({...settings, rows: settings.rows.map(({afferent, set}) => ({afferent, set: new Map(set)})), contact: new Map(settings.contact)});

/// Gives changes of a set of settings to the engine, one after the other. A change that the engine refuses is taken back.
export class SettingQueue {
    private last: Promise<unknown> = Promise.resolve();
    private newest = new Map<string, number>();  // number of the newest change of each setting

    /// `send`: gives the set to the engine, and returns false if it refuses.
    constructor(private set: Map<string, string>, private send: () => Promise<boolean>) {}

    /// Changes a setting; null restores the default. Returns true if the engine has accepted it, and null if a newer change has replaced it.
    change(name: string, text: string | null): Promise<boolean | null> {
        const number = (this.newest.get(name) || 0) + 1;
        this.newest.set(name, number);
        const isNewest = () => this.newest.get(name) === number;
        const done = this.last.then(async () => {
            if (!isNewest()) return null;
            const before = this.set.get(name);
            if (text === null) this.set.delete(name); else this.set.set(name, text);
            const isAccepted = await this.send();
            if (!isAccepted && before === undefined) this.set.delete(name);
            else if (!isAccepted) this.set.set(name, before!);
            return isNewest() || isAccepted ? isAccepted : null;
        });
        this.last = done;
        return done;
    }
}

function parsedSettings(texts: string[]): Map<string, string> | null {
    const out = new Map<string, string>();
    for (const text of texts) {
        const [, name, value] = /^([\w.-]{1,80})=([^=~,]{1,80})$/.exec(text) || [];
        if (!name) return null;
        out.set(name, value);
    }
    return out;
}

/// The rows of a link: "sa1~f_B=25Hz,sa1-circuit". The engine knows more names than the catalogue has, such as SA1 and sa1b+izhikevich, and
/// refuses the others.
function parsedRows(text: string): RowSettings[] | null {
    const rows: RowSettings[] = [];
    if (text === "none") return rows;
    for (const part of text.split(",").filter(Boolean)) {
        const [afferent, ...rest] = part.split("~"), set = parsedSettings(rest);
        if (!set || !/^[\w .+\/\\:-]{1,80}$/.test(afferent)) return null;
        rows.push({afferent, set});
    }
    return rows.length <= MAX_ROWS ? rows : null;
}

/// The settings in the link of the page; if it is damaged, the name of the damaged part, or "" if it cannot be divided into parts.
export function settingsOfLink(catalogue: Catalogue): Settings | string {
    const values = linkValues(location.hash, MAX_LINK), out = defaultSettings(catalogue);
    if (!values) return "";
    const number = (name: string, low: number, high: number, fallback: number) => {
        if (!values.has(name)) return fallback;
        const value = linkNumber(values.get(name));
        return value !== null && value >= low && value <= high ? value : NaN;
    };
    const rows = values.has("rows") ? parsedRows(values.get("rows")!) : out.rows;
    const contact = parsedSettings((values.get("contact") || "").split("~").filter(Boolean));
    const skin = values.get("skin") ?? out.population, indenter = values.get("indenter") ?? out.indenter;
    const isSkin = skin === "" || skin === "none" || catalogue.populations.some(({name}) => name === skin), isIndenter = catalogue.indenters.some(({name}) => name === indenter);
    const isGood = new Map([["rows", rows !== null], ["contact", contact !== null], ["skin", isSkin], ["indenter", isIndenter]]);
    Object.assign(out, {rate: number("rate", 500, 100_000, out.rate), seed: number("seed", 0, 2 ** 53, out.seed), force: number("force", MIN_FORCE, MAX_FORCE, out.force)});
    for (const name of ["rate", "seed", "force"] as const) isGood.set(name, !Number.isNaN(out[name]));
    const damaged = [...values.keys()].find((name) => !isGood.get(name));
    return damaged ?? {...out, rows: rows!, contact: contact!, population: skin === "none" ? "" : skin, indenter};
}

export function putSettingsInLink({rate, seed, force, rows, population, indenter, contact}: Settings) {
    setLink({rate, seed, force, skin: population || "none", indenter, contact: settingTexts(contact).join("~"),
             rows: rows.map(({afferent, set}) => [afferent, ...settingTexts(set)].join("~")).join(",") || "none"});
}
