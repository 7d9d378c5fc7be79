"use strict";
// A page of studies: published and computed numbers, then the figures.

const data = JSON.parse(document.getElementById("data").textContent);
const NUMBERS = ["computed", "published", "deviation", "allowed"];

/// The cells of a claim: its label, four numbers (NUMBERS), the verdict, its kind, and the source with the reason for a deviation. On a narrow
/// screen CSS shows data-column beside each number.
function claimCells({label, texts, verdict, kind: claimKind, source, note}) {
    const numbers = texts.map((text, k) => `<td class="number" data-column="${NUMBERS[k]}">${escaped(text === "-" ? "\u2013" : text)}</td>`).join("");
    const kind = {holds: "holds", agrees: "holds", differs: "fails", "does not hold": "fails"}[verdict] || "";
    return `<td class="what">${escaped(label)}</td>${numbers}<td class="verdict ${kind}">${verdict}</td><td class="kind unit">${verdict ? claimKind : ""}</td><td class="reason unit">${escaped([source, note].filter(Boolean).join("; "))}</td>`;
}

/// A table of claims. `first`: headings of columns before those of claimCells(), and the function that returns their HTML cells for a claim.
function showTable(host, claims, first = [], firstCells = () => "") {
    const head = [...first, "", ...NUMBERS, "", "kind", "source and reason"].map((text) => `<th scope="col">${text}</th>`).join("");
    const rows = claims.map((claim) => `<tr data-kind="${claim.verdict ? claim.kind : ""}">${firstCells(claim)}${claimCells(claim)}</tr>`).join("");
    element(host, "div", "scroll", `<table class="claims"><thead><tr>${head}</tr></thead><tbody>${rows}</tbody></table>`);
}

function showClaims(host, claims) {
    if (claims.length) showTable(host, claims);
}

/// The counts of agreeing and deviating claims of each kind, and what the kinds mean.
function showKinds(host, kinds) {
    const section = element(host, "section", "kinds");
    element(section, "h2", "", `Kinds of claims <small>${escaped(data.headline)}</small>`);
    const groups = [["printed", "agree", "differ"], ["derived", "agree", "differ"], ["statements", "hold", "do not"]];
    const head = `<tr><th></th>${groups.map(([name]) => `<th scope="colgroup" colspan="2">${name}</th>`).join("")}<th></th></tr>` +
        `<tr><th scope="col">kind</th>${groups.map(([, ...names]) => names.map((name) => `<th scope="col">${name}</th>`).join("")).join("")}<th scope="col" class="meaning">meaning</th></tr>`;
    const rows = kinds.map((one) => `<tr><th scope="row">${one.kind}</th>${groups.map(([name, yes, no]) =>
        `<td class="number" data-column="${name}: ${yes}">${one[name].agreeing}</td><td class="number" data-column="${no}">${one[name].deviating}</td>`).join("")}<td class="meaning unit">${escaped(one.meaning)}</td></tr>`).join("");
    element(section, "div", "scroll", `<table><thead>${head}</thead><tbody>${rows}</tbody></table>`);
}

/// If there are several studies, shows a table of those claims of all of them that have a published number or deviate. A checkbox hides the
/// rows without a deviation, a menu the rows of other kinds.
function showDeviations(host, studies) {
    const claims = studies.flatMap(({name, claims: all}) => all.filter((claim) => claim.on_top).map((claim) => ({...claim, study: name})));
    if (studies.length < 2 || !claims.length) return;
    const section = element(host, "section", "deviations");
    element(section, "h2", "", "Published and computed numbers, and deviations");
    const controls = element(section, "p", "controls");
    const label = element(controls, "label", "", `<input type="checkbox"> Deviations only`);
    const kinds = data.kinds.map(({kind}) => kind).filter((kind) => claims.some((claim) => claim.verdict && claim.kind === kind));
    const menu = element(controls, "label", "", `Kind <select><option value="">all</option>${kinds.map((kind) => `<option>${kind}</option>`).join("")}</select>`).querySelector("select");
    showTable(section, claims, ["study"], ({study}) => `<td class="study"><a href="#${study}">${study}</a></td>`);
    label.firstChild.addEventListener("change", (event) => section.classList.toggle("off-only", event.target.checked));
    menu.addEventListener("change", () => {
        for (const row of section.querySelectorAll("tbody tr")) row.hidden = menu.value !== "" && row.dataset.kind !== menu.value;
    });
}

document.getElementById("title").textContent = data.title;
document.getElementById("program").textContent = data.program;
document.getElementById("command").textContent = data.command;
showKinds(document.getElementById("studies"), data.kinds);
showDeviations(document.getElementById("studies"), data.studies);
for (const study of data.studies) {
    const host = element(document.getElementById("studies"), "section");
    host.id = study.name;
    element(host, "h2", "", `${escaped(study.title)} <small>${escaped(study.question)}</small>`);
    showClaims(host, study.claims);
    const plots = element(host, "div", "plots");
    for (const plot of study.plots) showPlot(plots, plot);
    for (const note of study.notes) element(host, "p", "", escaped(note));
}
