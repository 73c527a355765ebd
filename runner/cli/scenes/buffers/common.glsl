// Stands in front of every pass. The water is a grid, a pixel a cell: Buffer A keeps it from frame to frame, Image
// shows it.

// A cell: x its height, y how much that changes a frame.
#define Cell vec2

// At and beyond the edge the water is as high as at it: waves come back from there.
Cell cell_at(sampler2D water, ivec2 place) {
    return texelFetch(water, clamp(place, ivec2(0), textureSize(water, 0) - 1), 0).xy;
}
