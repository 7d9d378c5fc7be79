// The panels of the page by their names, for tests and for scripts of the user: corpuscle.panels["force"].

import type {Panel} from "../plot/panel";
import {onAppearanceChange} from "./colours";

declare global { interface Window { corpuscle?: {panels: Record<string, Panel>} } }

/// Exposes panels, which then also follow the theme.
export function expose(...panels: Panel[]) {
    if (!window.corpuscle) onAppearanceChange(() => Object.values(window.corpuscle!.panels).forEach(({view}) => view.request()));
    const known = (window.corpuscle = window.corpuscle || {panels: {}}).panels;
    for (const panel of panels) known[panel.name] = panel;
}

/// Forgets panels that were removed from the page.
export function forgetRemoved() {
    const known = window.corpuscle?.panels || {};
    for (const name of Object.keys(known)) if (!known[name].root.isConnected) delete known[name];
}
