//: buffer
//: pixel 31 0 0 255
// ShaderToy puts 27 lines before the text of a buffer.
void mainImage(out vec4 c, in vec2 p) { c = vec4(float(__LINE__), 0.0, 0.0, 255.0) / 255.0; }
