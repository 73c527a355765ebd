#iChannel0 "faces.png"
#iChannel0::Type "CubeMap"
#iChannel0::MinFilter "Linear"
#iChannel0::MagFilter "Linear"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec3 edge = fragCoord.x < 1.0 ? vec3(1.0, 1.0, 0.0) : vec3(-1.0, -1.0, 0.0);
    fragColor = textureLod(iChannel0, edge, 0.0);
}
