//: pixel 0 255 0
// A function of each built-in's name, and one call that only the built-in one answers: all stand side by side.
struct Own { float value; };
float radians(Own own) { return own.value; }
float degrees(Own own) { return own.value; }
float sin(Own own) { return own.value; }
float cos(Own own) { return own.value; }
float tan(Own own) { return own.value; }
float asin(Own own) { return own.value; }
float acos(Own own) { return own.value; }
float sinh(Own own) { return own.value; }
float cosh(Own own) { return own.value; }
float tanh(Own own) { return own.value; }
float asinh(Own own) { return own.value; }
float acosh(Own own) { return own.value; }
float atanh(Own own) { return own.value; }
float exp(Own own) { return own.value; }
float log(Own own) { return own.value; }
float exp2(Own own) { return own.value; }
float log2(Own own) { return own.value; }
float sqrt(Own own) { return own.value; }
float inversesqrt(Own own) { return own.value; }
float floor(Own own) { return own.value; }
float trunc(Own own) { return own.value; }
float round(Own own) { return own.value; }
float roundEven(Own own) { return own.value; }
float ceil(Own own) { return own.value; }
float fract(Own own) { return own.value; }
float normalize(Own own) { return own.value; }
float dFdx(Own own) { return own.value; }
float dFdy(Own own) { return own.value; }
float fwidth(Own own) { return own.value; }
float atan(Own own) { return own.value; }
float pow(Own own) { return own.value; }
float reflect(Own own) { return own.value; }
float refract(Own own) { return own.value; }
float faceforward(Own own) { return own.value; }
float abs(Own own) { return own.value; }
float sign(Own own) { return own.value; }
float mod(Own own) { return own.value; }
float modf(Own own) { return own.value; }
float min(Own own) { return own.value; }
float max(Own own) { return own.value; }
float clamp(Own own) { return own.value; }
float mix(Own own) { return own.value; }
float step(Own own) { return own.value; }
float smoothstep(Own own) { return own.value; }
float isnan(Own own) { return own.value; }
float isinf(Own own) { return own.value; }
float floatBitsToInt(Own own) { return own.value; }
float floatBitsToUint(Own own) { return own.value; }
float intBitsToFloat(Own own) { return own.value; }
float uintBitsToFloat(Own own) { return own.value; }
float length(Own own) { return own.value; }
float distance(Own own) { return own.value; }
float dot(Own own) { return own.value; }
float cross(Own own) { return own.value; }
float matrixCompMult(Own own) { return own.value; }
float inverse(Own own) { return own.value; }
float determinant(Own own) { return own.value; }
float transpose(Own own) { return own.value; }
float outerProduct(Own own) { return own.value; }
float lessThan(Own own) { return own.value; }
float lessThanEqual(Own own) { return own.value; }
float greaterThan(Own own) { return own.value; }
float greaterThanEqual(Own own) { return own.value; }
float equal(Own own) { return own.value; }
float notEqual(Own own) { return own.value; }
float any(Own own) { return own.value; }
float all(Own own) { return own.value; }
float not(Own own) { return own.value; }
float texture(Own own) { return own.value; }
float textureLod(Own own) { return own.value; }
float textureGrad(Own own) { return own.value; }
float texelFetch(Own own) { return own.value; }
float textureSize(Own own) { return own.value; }
void mainImage(out vec4 o, vec2 p) {
    Own own = Own(0.0);
    float sum = cos(0.0);
    sum += radians(own) + degrees(own) + sin(own) + cos(own) + tan(own);
    sum += asin(own) + acos(own) + sinh(own) + cosh(own) + tanh(own);
    sum += asinh(own) + acosh(own) + atanh(own) + exp(own) + log(own);
    sum += exp2(own) + log2(own) + sqrt(own) + inversesqrt(own) + floor(own);
    sum += trunc(own) + round(own) + roundEven(own) + ceil(own) + fract(own);
    sum += normalize(own) + dFdx(own) + dFdy(own) + fwidth(own) + atan(own);
    sum += pow(own) + reflect(own) + refract(own) + faceforward(own) + abs(own);
    sum += sign(own) + mod(own) + modf(own) + min(own) + max(own);
    sum += clamp(own) + mix(own) + step(own) + smoothstep(own) + isnan(own);
    sum += isinf(own) + floatBitsToInt(own) + floatBitsToUint(own) + intBitsToFloat(own) + uintBitsToFloat(own);
    sum += length(own) + distance(own) + dot(own) + cross(own) + matrixCompMult(own);
    sum += inverse(own) + determinant(own) + transpose(own) + outerProduct(own) + lessThan(own);
    sum += lessThanEqual(own) + greaterThan(own) + greaterThanEqual(own) + equal(own) + notEqual(own);
    sum += any(own) + all(own) + not(own) + texture(own) + textureLod(own);
    sum += textureGrad(own) + texelFetch(own) + textureSize(own);
    o = vec4(0, sum, 0, 1);
}
