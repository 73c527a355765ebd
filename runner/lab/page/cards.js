// Shows the card of the point under the pointer or with the focus; a click or a tap keeps it.
let kept = points.length > 0 ? points[0].id : null;
const show = id => {
    for (const element of all(".card, .mark, tr[data-point]"))
        element.classList.toggle("shown", Number(element.dataset.point) === id);
};
for (const mark of all("a[data-point]")) {
    const id = Number(mark.dataset.point);
    mark.addEventListener("pointerenter", () => show(id));
    mark.addEventListener("pointerleave", () => show(kept));
    mark.addEventListener("focus", () => show(id));
    mark.addEventListener("blur", () => show(kept));
    mark.addEventListener("click", event => {
        event.preventDefault();
        show(kept = id);
        const cards = document.querySelector(".cards");
        const box = cards.getBoundingClientRect();
        if (box.top > innerHeight - 80 || box.bottom < 80) cards.scrollIntoView({block: "nearest"});
    });
}
show(kept);
