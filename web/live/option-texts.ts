// The field "Options of the recording": options as they are typed after `corpuscle respond FILE`.

const HOW = "write for example --rate 1kHz";

/// The words of a line, as a shell divides it: quotation marks of both kinds keep blanks together, a backslash keeps the next character.
function words(line: string): string[] {
    const rest = line.replace(/(?:'[^']*'|"(?:[^"\\]|\\.)*"|\\.|[^\s'"\\])+|\s+/gs, "");
    if (rest[0] === "\\") throw new Error("options of the recording: a character is missing after the backslash at the end");
    if (rest) throw new Error(`options of the recording: ${rest[0]} is not closed; write it twice around a text, as in --channel "right thumb"`);
    const unquoted = (part: string) => {
        if (part[0] === "'") return part.slice(1, -1);
        return part[0] === '"' ? part.slice(1, -1).replace(/\\(["\\])/g, "$1") : part[0] === "\\" ? part[1] : part;
    };
    return (line.match(/(?:'[^']*'|"(?:[^"\\]|\\.)*"|\\.|[^\s'"\\])+/gs) || []).map((word) => word.replace(/'[^']*'|"(?:[^"\\]|\\.)*"|\\./gs, unquoted));
}

/// The options of a line by their names: "--abs -c Fz --notch=50Hz --notch 100Hz" is {abs: ["true"], channel: ["Fz"], notch: ["50Hz", "100Hz"]}.
/// Throws an error if a word is neither an option nor the value of one.
export function optionTexts(line: string): Record<string, string[]> {
    const all = words(line), options = new Map<string, string[]>();
    for (let k = 0; k < all.length; ++k) {
        const [, long, equals, after, short, attached] = /^(?:--([a-z][a-z-]*)(?:(=)(.*))?|-(c)=?(.*))$/s.exec(all[k]) || [];
        if (!long && !short) throw new Error(`options of the recording: '${all[k]}' is not an option; ${HOW}`);
        const name = long || "channel", hasNoValue = k + 1 === all.length || /^-(-[a-z]|c)/.test(all[k + 1]);
        options.set(name, [...(options.get(name) || []), equals ? after : attached || (hasNoValue ? "true" : all[++k])]);
    }
    return Object.fromEntries(options);
}
