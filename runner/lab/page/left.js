// Fades the points that the limits and the hidden series exclude, and describes the rest in a sentence.
const best = (left, key) => left.filter(point => point[key] !== null)
    .reduce((a, b) => (a === null || b[key] < a[key] ? b : a), null);
const told = () => {
    const left = points.filter(isLeft), count = `${left.length} of ${points.length} settings are left`;
    if (left.length === points.length || left.length === 0) return count + ".";
    const fastest = best(left, "time"), exact = best(left, "error");
    return count + (fastest ? `; the fastest: ${fastest.label}` : "") + (exact ? `; the most exact: ${exact.label}` : "") + ".";
};
const update = () => {
    const byId = new Map(points.map(point => [point.id, point]));
    for (const element of all("[data-point]:not(.card)")) {
        const point = byId.get(Number(element.dataset.point));
        if (!point) continue;
        element.classList.toggle("out", !isLeft(point));
        element.classList.toggle("off", isOff(point));
    }
    for (const line of all(".line")) {
        const own = points.filter(point => point.series === Number(line.dataset.series));
        line.classList.toggle("out", !own.some(isLeft));
        line.classList.toggle("off", own.every(isOff));
    }
    document.querySelector(".limits output").textContent = told();
};
