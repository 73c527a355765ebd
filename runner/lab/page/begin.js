// Shared by the scripts of a diagram: its points, the limits, and which points remain.
const {points} = JSON.parse(document.getElementById("data").textContent);
const all = (selector, root = document) => [...root.querySelectorAll(selector)];
const svgElement = (svg, name, attributes) => {
    const element = document.createElementNS(svg.namespaceURI, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    return element;
};
const limits = {error: Infinity, time: Infinity};
const seriesOff = new Set();
const isOff = point => seriesOff.has(point.series);
// A point without an error or a time passes only if that limit is off.
const keeps = (value, limit) => limit === Infinity || (value !== null && value <= limit);
const isLeft = point => !isOff(point) && keeps(point.error, limits.error) && keeps(point.time, limits.time);
document.documentElement.classList.add("scripted");
for (const element of all("[data-scripted]")) element.hidden = false;
