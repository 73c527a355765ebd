#version 300 es
precision highp float;
precision mediump int;
highp vec3 colour(mediump float x) {
    return vec3(x);
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(colour(0.2), 1.0);
}
