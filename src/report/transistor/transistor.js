"use strict";
// The page of a fitted transistor: its values, then measured points and computed curves with their differences.

const data = JSON.parse(document.getElementById("data").textContent);
const host = document.getElementById("transistor");

function showValues() {
    const head = ["parameter", "card", "value", "95 % interval", ""].map((text) => `<th scope="col">${text}</th>`).join("");
    const rows = data.fit.parameters.map((one) => `<tr><th scope="row">${escaped(one.name)}</th><td>${escaped(one.card)}</td>` +
        `<td class="number">${escaped(one.text)}</td><td>${escaped(one.interval)}</td>` +
        `<td class="reason unit">${escaped(one.not_determined ?? "")}</td></tr>`).join("");
    element(host, "div", "scroll", `<table class="claims"><thead><tr>${head}</tr></thead><tbody>${rows}</tbody></table>`);
    element(host, "p", "", escaped(data.misfit));
}

document.getElementById("title").textContent = data.title;
document.getElementById("program").textContent = data.program;
document.getElementById("command").textContent = data.command;
showValues();
const plots = element(host, "div", "plots");
for (const plot of data.plots) showPlot(plots, plot);
