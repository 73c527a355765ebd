const float far = 1.0 / 0.0;
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float fog = far * (uv.x + 1.0); // born +Inf; origin the constant far
    fragColor = vec4(fog);
}
