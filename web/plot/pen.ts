// The drawing commands of the panels. A panel draws with a Pen: the context of a canvas, or an SvgPen, which writes the same drawing as SVG.

export type Pen = Pick<CanvasRenderingContext2D, "beginPath" | "moveTo" | "lineTo" | "closePath" | "arc" | "rect" | "stroke" | "fill" | "fillRect" |
    "fillText" | "measureText" | "save" | "restore" | "clip" | "setLineDash" | "strokeStyle" | "fillStyle" | "lineWidth" | "lineJoin" | "font" | "textAlign" |
    "textBaseline" | "globalAlpha" | "imageSmoothingEnabled"> & {
    /// Draws a part of a canvas, scaled to (x, y, w, height).
    drawImage(image: HTMLCanvasElement, sx: number, sy: number, sw: number, sh: number, x: number, y: number, w: number, height: number): void;
};

const escaped = (text: string) => text.replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
const rounded = (v: number) => String(+v.toFixed(2));

interface Style {
    strokeStyle: string; fillStyle: string; lineWidth: number; font: string; textAlign: CanvasTextAlign; textBaseline: CanvasTextBaseline;
    globalAlpha: number; dash: number[]; clips: number;
}

/// Writes a drawing as SVG. A clip is that of the current path, which must be a rectangle.
export class SvgPen implements Pen {
    strokeStyle = "#000";
    fillStyle = "#000";
    lineWidth = 1;
    lineJoin: CanvasLineJoin = "miter";
    font = "11px sans-serif";
    textAlign: CanvasTextAlign = "start";
    textBaseline: CanvasTextBaseline = "alphabetic";
    globalAlpha = 1;
    imageSmoothingEnabled = true;
    private dash: number[] = [];
    private path: string[] = [];
    private parts: string[] = [];
    private saved: Style[] = [];
    private clips = 0;  // open groups with a clip
    private clipCount = 0;
    private measure = document.createElement("canvas").getContext("2d")!;

    beginPath() { this.path = []; }
    moveTo(x: number, y: number) { this.path.push(`M${rounded(x)} ${rounded(y)}`); }
    lineTo(x: number, y: number) { this.path.push(`L${rounded(x)} ${rounded(y)}`); }
    closePath() { this.path.push("Z"); }
    rect(x: number, y: number, w: number, height: number) { this.path.push(`M${rounded(x)} ${rounded(y)}h${rounded(w)}v${rounded(height)}h${rounded(-w)}Z`); }

    arc(x: number, y: number, r: number, from: number, to: number) {
        const at = (angle: number) => `${rounded(x + r * Math.cos(angle))} ${rounded(y + r * Math.sin(angle))}`;
        const middle = (from + to) / 2, curve = (angle: number) => `A${rounded(r)} ${rounded(r)} 0 0 1 ${at(angle)}`;
        this.path.push(`M${at(from)}${curve(middle)}${curve(to)}`);
    }

    stroke() {
        const dash = this.dash.length ? ` stroke-dasharray="${this.dash.join(" ")}"` : "";
        this.parts.push(`<path d="${this.path.join("")}" fill="none" stroke="${escaped(this.strokeStyle)}" stroke-width="${rounded(this.lineWidth)}"${dash}${this.opacity()}/>`);
    }

    fill() { this.parts.push(`<path d="${this.path.join("")}" fill="${escaped(this.fillStyle)}"${this.opacity()}/>`); }

    fillRect(x: number, y: number, w: number, height: number) {
        this.parts.push(`<rect x="${rounded(x)}" y="${rounded(y)}" width="${rounded(w)}" height="${rounded(height)}" fill="${escaped(this.fillStyle)}"${this.opacity()}/>`);
    }

    fillText(text: string, x: number, y: number) {
        const anchor = {center: "middle", right: "end", end: "end", left: "start", start: "start"}[this.textAlign];
        const shift = this.textBaseline === "middle" ? "0.35em" : this.textBaseline === "top" ? "0.8em" : "0";
        const size = /(\d+(?:\.\d+)?)px/.exec(this.font)![1], weight = /^(bold|600)/.test(this.font) ? ' font-weight="600"' : /^italic/.test(this.font) ? ' font-style="italic"' : "";
        this.parts.push(`<text x="${rounded(x)}" y="${rounded(y)}" dy="${shift}" text-anchor="${anchor}" font-size="${size}"${weight} fill="${escaped(this.fillStyle)}"${this.opacity()}>${escaped(text)}</text>`);
    }

    measureText(text: string) {
        this.measure.font = this.font;
        return this.measure.measureText(text);
    }

    drawImage(image: HTMLCanvasElement, sx: number, sy: number, sw: number, sh: number, x: number, y: number, w: number, height: number) {
        const part = document.createElement("canvas");
        [part.width, part.height] = [Math.max(1, Math.round(sw)), Math.max(1, Math.round(sh))];
        part.getContext("2d")!.drawImage(image, sx, sy, sw, sh, 0, 0, part.width, part.height);
        const style = this.imageSmoothingEnabled ? "" : ' style="image-rendering: pixelated"';
        this.parts.push(`<image x="${rounded(x)}" y="${rounded(y)}" width="${rounded(w)}" height="${rounded(height)}" preserveAspectRatio="none"${style} href="${part.toDataURL()}"${this.opacity()}/>`);
    }

    save() {
        const {strokeStyle, fillStyle, lineWidth, font, textAlign, textBaseline, globalAlpha, dash, clips} = this;
        this.saved.push({strokeStyle, fillStyle, lineWidth, font, textAlign, textBaseline, globalAlpha, dash, clips});
    }

    restore() {
        const before = this.saved.pop();
        if (!before) return;
        for (; this.clips > before.clips; --this.clips) this.parts.push("</g>");
        Object.assign(this, before);
    }

    clip() {
        const id = `clip${++this.clipCount}`;
        this.parts.push(`<clipPath id="${id}"><path d="${this.path.join("")}"/></clipPath><g clip-path="url(#${id})">`);
        ++this.clips;
    }

    setLineDash(dash: number[]) { this.dash = dash; }

    private opacity() { return this.globalAlpha < 1 ? ` opacity="${rounded(this.globalAlpha)}"` : ""; }

    /// The drawing as a file.
    text(width: number, height: number, title: string): string {
        return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="system-ui, sans-serif">` +
            `<title>${escaped(title)}</title>${this.parts.join("\n")}</svg>\n`;
    }
}
