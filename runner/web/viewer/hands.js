// ---- Mouse and keyboard

const BUTTONS = ["left", "middle", "right"];

// Moves are sent while a button is down, and always if the mouse follows the pointer, as in the window, or a lens shows the
// value under it.
function sendPointer(canvas, link, size, sendsEveryMove) {
    const at = event => {
        const [x, y] = placeIn(canvas, event, size());
        return {x, y};
    };
    const button = event => ({button: BUTTONS[event.button], ...at(event)});
    canvas.addEventListener("pointerdown", event => {
        canvas.setPointerCapture(event.pointerId);
        canvas.focus({preventScroll: true});
        if (event.button in BUTTONS)
            link.send("press", button(event));
        if (event.button === 1)
            event.preventDefault(); // otherwise the page scrolls
    });
    canvas.addEventListener("pointermove", event => {
        // If a second button goes down or up while the first is held, browsers report a move.
        if (event.button in BUTTONS)
            link.send(event.buttons & [1, 4, 2][event.button] ? "press" : "release", button(event));
        else if (event.buttons || sendsEveryMove())
            link.send("move", at(event));
    });
    canvas.addEventListener("pointerup", event => event.button in BUTTONS && link.send("release", button(event)));
    canvas.addEventListener("pointercancel", () => link.send("let go"));
    canvas.addEventListener("contextmenu", event => event.preventDefault());
    canvas.addEventListener("wheel", event => {
        event.preventDefault();
        link.send("wheel", {up: -Math.sign(event.deltaY)});
    }, {passive: false});
}

// The window's keys that work here too.
const WINDOW_KEYS = /^( |ArrowLeft|ArrowRight|Home|r|c|[0-9])$/;

// A scene that reads the keyboard gets all keys except those that leave the picture.
function sendKeys(canvas, link, sceneReads, toggleFullScreen) {
    canvas.addEventListener("keydown", event => {
        if (event.ctrlKey || event.altKey || event.metaKey || ["Tab", "Escape"].includes(event.key))
            return;
        if (event.key === "f" && !sceneReads())
            return event.repeat || toggleFullScreen();
        if (!sceneReads() && !WINDOW_KEYS.test(event.key))
            return;
        event.preventDefault();
        const steps = !sceneReads() && event.key.startsWith("Arrow");
        if ((!event.repeat || steps) && event.keyCode >= 1 && event.keyCode <= 255)
            link.send("keydown", {code: event.keyCode});
    });
    canvas.addEventListener("keyup", event => {
        if (event.keyCode >= 1 && event.keyCode <= 255)
            link.send("keyup", {code: event.keyCode});
    });
    canvas.addEventListener("blur", () => link.send("let go"));
}

