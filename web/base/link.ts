// The state of a page in its link: "#channel=3&from=0.5&to=1.25", or first the name of a part of the page: "#fig13&by=label". A
// link with an unknown or repeated key, or a value that is too long, is refused.

const MAX_LINK = 4000;

/// The values in the link of the page; null if the link is damaged, or longer than `most`. The name of a part of the page has the key "".
export function linkValues(text = location.hash, most = MAX_LINK): Map<string, string> | null {
    if (text.length > most) return null;
    const values = new Map<string, string>();
    const parts = text.replace(/^#/, "").split("&").filter(Boolean);
    if (parts.length && /^[\w.-]+$/.test(parts[0])) values.set("", parts.shift()!);
    for (const part of parts) {
        const [, name, value] = /^([a-z][\w-]*)=(.*)$/i.exec(part) || [];
        if (!name || values.has(name)) return null;
        try {
            values.set(name, decodeURIComponent(value));
        } catch {
            return null;  // a malformed escape
        }
    }
    return values;
}

let timer = 0;
let delayed = () => {};  // puts the values of the last setLink() into the link

/// Puts values into the link of the page, without an entry in the history. Values that are null are left out. The last of several calls counts,
/// because browsers limit how often a link may change.
export function setLink(values: Record<string, string | number | null | undefined>) {
    const text = Object.entries(values).filter(([, value]) => value !== null && value !== undefined && value !== "").map(([name, value]) => (name && `${name}=`) + encodeURIComponent(value!)).join("&");
    clearTimeout(timer);
    delayed = () => replaceLink(text);
    timer = window.setTimeout(delayed, 200);
}

/// The address of the page with the values of the last setLink(), which are otherwise delayed.
export function currentAddress(): string {
    clearTimeout(timer);
    delayed();
    return location.href;
}

function replaceLink(text: string) {
    if (location.hash.replace(/^#/, "") === text) return;
    try {
        history.replaceState(null, "", text ? `#${text}` : location.pathname + location.search);
    } catch {
        // a page in a sandboxed frame has no link
    }
}

/// Calls `follow` when the user has changed the address; setLink() causes no such event. If the delayed change of a setLink() has replaced the
/// address since, it is put back.
export function onLinkChange(follow: () => void) {
    addEventListener("hashchange", ({newURL}) => {
        clearTimeout(timer);
        delayed = () => {};
        replaceLink(new URL(newURL).hash.replace(/^#/, ""));
        follow();
    });
}

/// A number of a link; null if it is not one.
export const linkNumber = (text: string | undefined) => (text !== undefined && text.trim() !== "" && Number.isFinite(Number(text)) ? Number(text) : null);
