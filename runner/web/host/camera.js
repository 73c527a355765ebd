
// ---- iCamera and iViewMatrix

// Orbits a target at a distance. World y is up; at azimuth and elevation 0 the camera is on the positive z
// axis. Degrees.
class OrbitCamera {
    azimuth = 30;
    elevation = 20;
    distance = 10;
    target = [0, 0, 0];

    // Rotates for a drag of (dx, dy) pixels; a drag across `height` pixels is half a turn.
    turn(dx, dy, height) {
        this.azimuth = ((this.azimuth - dx / height * 180) % 360 + 360) % 360;
        this.elevation = Math.min(89.9, Math.max(-89.9, this.elevation - dy / height * 180));
    }

    zoom(notches) { this.distance = Math.min(1e6, Math.max(1e-3, this.distance * 0.9 ** notches)); }

    pan(dx, dy, height) {
        const [right, up] = this.axes, scale = this.distance / height;
        this.target = this.target.map((at, i) => at - (right[i] * dx + up[i] * dy) * scale);
    }

    get axes() {
        const azimuth = this.azimuth * Math.PI / 180, elevation = this.elevation * Math.PI / 180;
        const [sa, ca, se, ce] = [Math.sin(azimuth), Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation)];
        return [[ca, 0, -sa], [-sa * se, ce, -ca * se], [sa * ce, se, ca * ce]];
    }

    // Returns camera to world, by columns: right, up, backwards, position.
    get matrix() {
        const axes = this.axes, position = this.target.map((at, i) => at + this.distance * axes[2][i]);
        return [...axes, position].flatMap((column, i) => [...column, i === 3 ? 1 : 0]);
    }

    // Returns the motion since the initial position: iOrbit without its last number, and iOrbitPan.
    get motion() {
        const first = new OrbitCamera(), turned = (this.azimuth - first.azimuth + 540) % 360 - 180;
        const heading = first.azimuth * Math.PI / 180, [s, c] = [Math.sin(heading), Math.cos(heading)];
        const [x, y, z] = this.target.map(at => at / first.distance);
        return {orbit: [turned * Math.PI / 180, (this.elevation - first.elevation) * Math.PI / 180,
                        this.distance / first.distance], pan: [c * x - s * z, y, s * x + c * z]};
    }

    // Returns this camera's matrix in another camera's coordinates.
    seenFrom(other) {
        const theirs = other.matrix, ours = this.matrix, seen = [];
        for (let column = 0; column < 4; ++column) {
            const from = column === 3 ? 1 : 0, at = [0, 1, 2].map(i => ours[4 * column + i] - from * theirs[12 + i]);
            for (let row = 0; row < 3; ++row)
                seen.push(at[0] * theirs[4 * row] + at[1] * theirs[4 * row + 1] + at[2] * theirs[4 * row + 2]);
            seen.push(from);
        }
        return seen;
    }
}
