// Compares two pictures of the page with a divider between them, on every page that has the form for it.
const compared = document.querySelector(".compare");
if (compared) {
    const all = (selector, root = document) => [...root.querySelectorAll(selector)];
    const pictures = [...all(".reference img"), ...all(".card img")], slider = compared.querySelector(".slider");
    const [before, after] = all("img", slider), [left, right] = all(".choices select"), cut = compared.querySelector("input");
    for (const choice of [left, right])
        choice.append(...pictures.map((picture, i) => new Option(picture.dataset.name, i)));
    const showPair = () => {
        for (const [image, choice] of [[before, left], [after, right]]) {
            image.src = pictures[choice.value].src;
            image.alt = pictures[choice.value].dataset.name;
        }
    };
    const place = () => slider.style.setProperty("--cut", cut.value + "%");
    const drag = event => {
        const box = slider.getBoundingClientRect();
        cut.value = 100 * (event.clientX - box.left) / box.width;
        place();
    };
    slider.addEventListener("pointerdown", event => {
        event.preventDefault();
        slider.setPointerCapture(event.pointerId);
        drag(event);
    });
    slider.addEventListener("pointermove", event => { if (slider.hasPointerCapture(event.pointerId)) drag(event); });
    cut.addEventListener("input", place);
    for (const choice of [left, right]) choice.addEventListener("input", showPair);
    for (const card of all(".card")) {
        const own = pictures.findIndex(picture => card.contains(picture));
        for (const [choice, name] of own < 0 ? [] : [[left, "Compare on the left"], [right, "on the right"]]) {
            const button = document.createElement("button");
            button.textContent = name;
            button.addEventListener("click", () => {
                choice.value = own;
                showPair();
                compared.scrollIntoView({block: "nearest"});
            });
            card.querySelector(".choose").append(button);
        }
    }
    right.value = Math.min(1, pictures.length - 1);
    showPair();
    document.querySelector(".reference").hidden = true;
    compared.hidden = false;
}
