// Shows and hides series by the legend.
for (const item of all(".legend [data-series]")) {
    const button = document.createElement("button"), series = Number(item.dataset.series);
    button.append(...item.childNodes);
    button.setAttribute("aria-pressed", "true");
    button.addEventListener("click", () => {
        if (!seriesOff.delete(series)) seriesOff.add(series);
        button.setAttribute("aria-pressed", String(!seriesOff.has(series)));
        update();
    });
    item.append(button);
}
update();
