// The page of a stream: the forces of a sensor and the spikes of its afferents, as `corpuscle stream --serve` sends them.

import {messageOf, NumberArray} from "../base/arrays";
import {onAppearanceChange} from "../base/colours";
import {append, h} from "../base/dom";
import {connectKeys} from "../plot/pointer";
import {SkinScene} from "../skin/scene";
import {SkinMap} from "../skin/skin-map";
import {Charts, LiveSource} from "./charts";
import {HISTORY, LiveCurve, appendSpikes} from "./history";
import {Skin, skinOf} from "./session";
import {geometryOf, recentSpikes} from "./skin-view";

class StreamPage implements LiveSource {
    rows = [];
    skin: Skin | null = null;
    force = new LiveCurve("force", "N", 1e-3);
    time = 0;
    changes = 0;
    private drawn = -1;                             // changes that the map shows
    private siteForce = new Map<number, number>();  // N, of the last frame
    private most = 1e-6;                            // greatest force of a site so far, N
    private lost = {frames: 0, spikes: 0, messages: 0};
    private spikes = 0;
    private state = "connecting";
    private status = h("span", {class: "readout", id: "status"});
    private mapHost = h("div", {class: "skin-view-map"});
    private chartHost = h("div", {class: "charts"});
    private scene: SkinScene | null = null;
    private charts = new Charts(this, this.chartHost);

    constructor(url: string) {
        append(document.body, h("header", {}, h("h1", {id: "title"}, "Stream"), h("span", {class: "program", id: "description"})),
            h("div", {class: "toolbar"}, h("button", {type: "button", id: "follow", onclick: () => this.charts.followAgain()}, "Follow"), this.status),
            h("main", {class: "live"}, h("section", {class: "press"}, h("div", {class: "skin-view", id: "skin-view"}, this.mapHost)), h("section", {class: "responses"}, this.chartHost)));
        connectKeys(this.charts.view);
        onAppearanceChange(() => { this.scene?.renew(); this.charts.view.request(); });
        new ResizeObserver(() => this.resize()).observe(this.mapHost);
        const socket = new WebSocket(url);
        socket.binaryType = "arraybuffer";
        socket.onmessage = ({data}) => this.receive(data as ArrayBuffer);
        socket.onclose = ({reason}) => { if (this.state === "live" || this.state === "connecting") this.state = `disconnected${reason ? `: ${reason}` : ""}`; };
    }

    private receive(buffer: ArrayBuffer) {
        const {head, arrays} = messageOf(buffer) as {head: any; arrays: Record<string, NumberArray>};
        ++this.changes;
        if (head.event === "stream") this.start(head, arrays);
        else if (head.event === "frames") this.append(head, arrays);
        else if (head.event === "lost") [this.lost.messages, this.lost.spikes] = [this.lost.messages + head.messages, this.lost.spikes + head.spikes];
        else if (head.event === "end") this.state = "ended";
        else if (head.event === "refused") this.state = head.error;
    }

    private start(head: any, arrays: Record<string, NumberArray>) {
        this.skin = skinOf(head, arrays);
        this.force = new LiveCurve("total force", "N", 1 / head.force_rate);
        this.state = "live";
        document.getElementById("title")!.textContent = head.population;
        document.getElementById("description")!.textContent = [head.description, `${head.units} afferents`, `${head.rate} frames per second`].filter(Boolean).join(", ");
        this.mapHost.parentElement!.hidden = new Set(this.skin.siteX).size < 2 && new Set(this.skin.siteY).size < 2;
        this.scene = new SkinScene(geometryOf(this.skin, 0), (draw) => this.siteForce.forEach((newtons, site) => draw(site, newtons / this.most)));
        new SkinMap(this.scene, {host: this.mapHost, name: "skin", title: [], about: "the skin, the force on it, and its active afferents", classes: this.skin.classes.map((_, k) => k), hasRings: true,
                                 activity: (draw) => recentSpikes(this.skin!, this.time).forEach(([mark, level]) => draw(mark, level))});
        this.resize();
        this.charts.renew();
    }

    private append(head: any, arrays: Record<string, NumberArray>) {
        const {unit, time, frame_time: times = [], touched = [], site = [], force = []} = arrays;
        appendSpikes(this.skin!.trains, unit, time);
        this.spikes += unit ? unit.length : 0;
        for (let f = 0, k = 0; f < times.length; ++f) {
            let total = 0;
            this.siteForce.clear();
            for (const end = k + touched[f]; k < end; ++k) {
                total += force[k];
                this.most = Math.max(this.most, force[k]);
                this.siteForce.set(site[k], force[k]);
            }
            this.force.append([total], times[f]);
            this.time = Math.max(this.time, times[f]);
        }
        if (times.length) this.scene!.surface.forceChanged();
        if (time && time.length) this.time = Math.max(this.time, time[time.length - 1]);
        if (head.lost) [this.lost.frames, this.lost.spikes] = [this.lost.frames + head.lost.frames, this.lost.spikes + head.lost.spikes];
        this.skin!.trains.forEach((train) => train.forget(this.time - HISTORY));
    }

    private resize() {
        const {clientWidth, clientHeight} = this.mapHost;
        if (this.scene && clientWidth > 0) this.scene.resize(clientWidth, clientHeight);
    }

    /// Draws at each frame of the screen.
    run() {
        requestAnimationFrame(() => {
            this.run();
            if (this.drawn !== this.changes) this.scene?.draw();
            this.drawn = this.changes;
            this.charts.follow();
            const {frames, spikes, messages} = this.lost, missing = [frames && `${frames} frames`, spikes && `${spikes} spikes`, messages && `${messages} messages`].filter(Boolean).join(", ");
            const text = `${this.state}, ${this.time.toFixed(1)} s, ${this.spikes} spikes${missing ? `; this page missed ${missing}` : ""}`;
            if (this.status.textContent !== text) this.status.textContent = text;
        });
    }
}

/// Shows the stream behind a WebSocket.
export function showStreamPage(url: string) {
    const page = new StreamPage(url);
    (window as any).corpuscle = page;
    page.run();
}
