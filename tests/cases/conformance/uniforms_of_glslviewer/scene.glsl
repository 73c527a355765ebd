#ifdef GL_ES
precision mediump float;
#endif
uniform vec2 u_resolution;
uniform vec2 u_mouse;
uniform float u_time;
uniform float u_delta;
uniform int u_frame;
uniform vec4 u_date;
void main() {
    float column = floor(gl_FragCoord.x);
    vec4 color = vec4(u_date.xyz, 1.0);
    if (column == 0.0)
        color = vec4(u_resolution, u_time, 1.0);
    else if (column == 1.0)
        color = vec4(u_mouse, u_frame, 1.0);
    else if (column == 2.0)
        color = vec4(u_delta, u_date.w, 0.0, 1.0);
    gl_FragColor = color;
}
