#iChannel0 "four.png"
#iChannel0::MagFilter "Nearest"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = texture(iChannel0, (fragCoord - 2.0) / 2.0);
}
