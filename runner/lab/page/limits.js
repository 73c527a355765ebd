// Lines of allowed error and time, which are dragged, moved with the arrow keys, or typed.
const axisOf = (svg, name) => {
    const [low, high, first, last] = svg.dataset[name].split(" ").map(Number);
    return {low, high, first, last,
        pixel: value => first + (last - first) * Math.log(value / low) / Math.log(high / low),
        value: pixel => low * (high / low) ** ((pixel - first) / (last - first))};
};
const fields = {error: document.getElementById("most-error"), time: document.getElementById("most-time")};
const lines = [];
const setLimit = (key, value) => {
    limits[key] = value > 0 ? value : Infinity;
    for (const line of lines) if (line.key === key) line.place();
    update();
};
// A limit beyond the axis allows every point.
const turn = (key, axis, value) => {
    const limit = value >= axis.high ? Infinity : Math.max(value, axis.low);
    fields[key].value = limit === Infinity ? "" : Number(limit.toPrecision(3));
    setLimit(key, fields[key].value === "" ? Infinity : Number(fields[key].value));
};
// Creates the elements of one line: dashes across the diagram, and a grip at the axis.
const limitElements = (svg, key, axis) => {
    const group = svgElement(svg, "g", {class: "limit", role: "slider", tabindex: 0, "data-limit": key,
        "aria-label": key === "error" ? "most error allowed" : "most milliseconds allowed",
        "aria-valuemin": axis.low, "aria-valuemax": axis.high});
    const path = svgElement(svg, "path", {}), grip = svgElement(svg, "rect", {width: 12, height: 12, rx: 3});
    const reach = svgElement(svg, "circle", {r: 18});
    group.append(path, grip, reach);
    svg.append(group);
    return {group, path, grip, reach};
};
const placeLine = ({group, path, grip, reach}, key, name, x, y) => {
    const axis = name === "x" ? x : y, open = limits[key] === Infinity;
    const value = Math.min(Math.max(limits[key], axis.low), axis.high), at = axis.pixel(value);
    const [cx, cy] = name === "x" ? [at, y.first] : [x.last, at];
    path.setAttribute("d", name === "x" ? `M${at} ${y.first}V${y.last}` : `M${x.first} ${at}H${x.last}`);
    grip.setAttribute("x", cx - 6);
    grip.setAttribute("y", cy - 6);
    reach.setAttribute("cx", cx);
    reach.setAttribute("cy", cy);
    group.setAttribute("aria-valuenow", value);
    group.setAttribute("aria-valuetext", open ? "any" : String(limits[key]));
};
const addLine = (svg, key, name) => {
    const x = axisOf(svg, "x"), y = axisOf(svg, "y"), axis = name === "x" ? x : y;
    const elements = limitElements(svg, key, axis), {group} = elements;
    group.addEventListener("pointerdown", event => {
        event.preventDefault();
        group.focus();
        group.setPointerCapture(event.pointerId);
    });
    group.addEventListener("pointermove", event => {
        if (!group.hasPointerCapture(event.pointerId)) return;
        const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
        turn(key, axis, axis.value(at[name]));
    });
    group.addEventListener("keydown", event => {
        const way = {ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1}[event.key];
        if (!way) return;
        event.preventDefault();
        turn(key, axis, Math.min(limits[key], axis.high) * 1.05 ** way);
    });
    lines.push({key, place: () => placeLine(elements, key, name, x, y)});
    lines.at(-1).place();
};
for (const svg of all(".diagram")) {
    addLine(svg, "error", "y");
    if (svg.closest("[data-across=time]")) addLine(svg, "time", "x");
}
for (const [key, field] of Object.entries(fields)) field.addEventListener("input", () => setLimit(key, Number(field.value)));
document.querySelector(".limits").addEventListener("reset", () => setTimeout(() => Object.keys(fields).forEach(key => setLimit(key, Infinity))));
document.querySelector(".limits").addEventListener("submit", event => event.preventDefault());
