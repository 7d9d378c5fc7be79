// The catalogue of the engine: names, parameters, units and ranges come from here only.

export interface Parameter {
    name: string; unit: string; default: number; low: number | null; high: number | null; description: string; source?: string; component?: string;
    value?: number;
}

/// A number, choice or array of transistors that a circuit can be given beside its parameters.
export interface Setting { name: string; kind: "number" | "choice" | "array"; unit: string; value: number | string | null; choices?: string[]; block?: string; description: string }
export interface Afferent {
    name: string; class: string; composition: string; description: string; is_circuit: boolean; probes: {name: string; unit: string}[];
    parameters: Parameter[];
}
export interface Entry { name: string; description: string; parameters?: Parameter[] }

export interface Catalogue {
    version: string;
    afferents: Afferent[];
    populations: {name: string; description: string; afferents: number}[];
    indenters: {name: string; description: string}[];
    contact: Parameter[];
    stimuli: Entry[];
}

/// Joins the parts of the answer to the request `catalogue`. `head`: of the answer.
export function catalogueOf(head: any): Catalogue {
    const {sections} = head, entries = (name: string): any[] => sections[name] || [];
    const described = new Map(entries("afferents").map((one) => [one.name, one]));
    return {
        version: head.version, populations: head.populations, indenters: head.indenters, stimuli: entries("stimuli"),
        contact: entries("contact").flatMap(({parameters = []}) => parameters).filter((one, k, all) => all.findIndex(({name}) => name === one.name) === k),
        afferents: head.afferents.map((one: any) => ({...described.get(one.name), ...one})),
    };
}
