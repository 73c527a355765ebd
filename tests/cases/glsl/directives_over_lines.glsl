#iChannel0
    "textures/sand.png" // quotes end it
#iChannel0::WrapMode /* not
    Repeat */ "Mirror" float between;
#iUniform vec3 sun = vec3(0.0,
                          1.0,
                          0.0) in { -1.0, 1.0 } step 0.1
void mainImage(out vec4 fragColor, in vec2 fragCoord) { fragColor = vec4(sun, between); }
