// ---- Places in the picture

// Returns an event's position in a picture of that size: pixels from the bottom left.
function placeIn(canvas, {clientX, clientY}, [width, height] = [canvas.width, canvas.height]) {
    const shown = canvas.getBoundingClientRect();
    return [(clientX - shown.left) * width / shown.width, height - (clientY - shown.top) * height / shown.height];
}

