// Varies a text as SwiftShader, the software driver of Chromium, computes it. The polynomials and the order
// of operations are those that its sources state (its folder src/Pipeline of 2026, built with
// SWIFTSHADER_LEGACY_PRECISION as Chromium does), written anew in GLSL;
// tests/gl/variation_gl_test.cpp compares them with numbers that Chromium computed.
#include "shader/builtin_functions.hpp"
#include "shader/source_edits.hpp"
#include "shader/variables.hpp"
#include "shader/variation.hpp"
#include "shader/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::glsl {
namespace {

/// `$has(bit)` asks for a SwiftShaderPart. `precise` keeps the driver from reordering. A block of 2x2 pixels
/// has one derivative, that of its pixel with even coordinates (`$across`, `$upwards`). Drivers may compute
/// dFdxCoarse as dFdxFine, so that number is brought to the other pixels as the derivative of a number that
/// is zero there. llvmpipe computes any number for a quotient by zero that it knows when it compiles;
/// `$hidden` keeps a value from the compiler. Neighbours that do not take a branch have an influence on the
/// derivatives in it, so functions choose their result without a branch, except `$zero`: of a choice without
/// one LLVM would always take the number that is defined. What such pixels read by an index is 0 there, which
/// `$live` detects because llvmpipe does not write for them.
constexpr std::string_view k_swift_numbers = R"(uniform int $mode;bool $has(int part){return ($mode&part)!=0;}
float $bits(int b){return intBitsToFloat(b);}int $bits(float v){return floatBitsToInt(v);}
float $fma(float a,float b,float c){precise float p=a*b,r=p+c;return r;}
float $wave(float x){precise float s=x*x;return $fma($fma(74.4388885,s,-41.1693687),s,6.28230858)*x;}
float $sin(float x){precise float t=$fma(x,-0.159154937,0.25);
precise float z=0.25-abs(t-roundEven(t));float r=$wave(z),u=sin(x);return $has(1)?r:u;}
float $cos(float x){precise float t=x*0.159154937,z=0.25-abs(t-roundEven(t));
float r=$wave(z),u=cos(x);return $has(1)?r:u;}
float $tan(float x){float r=$sin(x)/$cos(x),u=tan(x);return $has(1)?r:u;}
float $arc(float x){precise float s=x*x;precise float r=-0.0161657367+s*0.0028662257;r=0.0429096138+s*r;
r=-0.0752896400+s*r;r=0.1065626393+s*r;r=-0.1420889944+s*r;r=0.1999355085+s*r;r=-0.3333314528+s*r;
r=x+x*(s*r);return r;}
float $signed(float v,float like){return $bits($bits(v)^($bits(like)&0x80000000));}
float $atan(float x){float a=abs(x),v=1.0/a,u=atan(x);bool far=a>=1.0;v=far?v:a;
precise float r=$arc(v),c=1.57079632-r;r=far?c:r;r=$signed(r,x);return $has(2)?r:u;}
float $atan(float y,float x){bool s=y<0.0;precise float t=s?-3.14159265:0.0;float x0=$signed(x,y),y0=abs(y);
bool q=x0<0.0;t+=q?1.57079632:0.0;float n0=-x0,x1=q?y0:x0,y1=q?n0:y0;
bool o=y1>=x1,whole=$has(y==0.0&&x==0.0?16:2);float x2=o?y1:x1,y2=o?x1:y1,u=atan(y,x);
bool endless=isinf(y2);precise float a=$arc(y2/x2),n=-a,b=1.57079632-a;b=o?b:a;b=x2==0.0?0.0:b;
t+=endless?0.785398163:b;t=s&&q&&o&&!endless?n:t;return whole?t:u;}
float $asin(float x){bool inside=$has(2)&&abs(x)<=1.0;
double a=double(abs(x));bool far=a>0.5lf;double w=sqrt((1.0lf-a)*0.5lf),v=far?w:a,t=v,s=v;
for(int n=0;n<16;++n){t*=v*v*double(2*n+1)/double(2*n+2);s+=t/double(2*n+3);}
w=1.5707963267948966lf-2.0lf*s;s=far?w:s;float r=$signed(float(s),x),u=asin(x);return inside?r:u;}
float $acos(float x){float a=abs(x),u=acos(x);
precise float r=0.0742610+a*-0.0187293;r=-0.2121144+a*r;r=1.5707288+a*r;r=1.57079632-sqrt(1.0-a)*r;
precise float c=1.57079632-$signed(r,x);return $has(2)?c:u;}
float $raise(float x){x=max(min(x,128.0),-126.999992);int i=int(roundEven(x-0.5));
precise float f=x-float(i),r=0.00187757669*f+0.00898933969;r=r*f+0.0558263175;r=r*f+0.240153611;
r=r*f+0.693153083;r=r*f+1.0;return $bits((i+127)<<23)*r;}
float $lower(float x){int b=$bits(x);float m=$bits((b&0x7fffff)|0x3f800000);
precise float e=($bits(((b&0x7f800000)>>8)|0x3f800000)-1.4960938)*256.0;
float u=$fma($fma(9.5428179e-2,m,4.7779095e-1),m,1.9782813e-1);
float v=$fma($fma($fma(1.6618466e-2,m,2.0350508e-1),m,2.7382900e-1),m,4.0496687e-2);
e=e+(m-1.0)*(u/v);e=b==0x7f800000?x:e;return e;}
float $exp2(float x){float r=$raise(x),u=exp2(x);return $has(4)?r:u;}
float $exp(float x){float r=$raise(1.44269504*x),u=exp(x);return $has(4)?r:u;}
float $log2(float x){float r=$lower(x),u=log2(x);return $has(x<0.0?16:4)?r:u;}
float $log(float x){float r=6.93147181e-1*$lower(x),u=log(x);return $has(x<0.0?16:4)?r:u;}
float $pow(float x,float y){float r=$raise($lower(x)*y),u=pow(x,y);
return $has(x<0.0||(x==0.0&&y<=0.0)?16:4)?r:u;}
float $sinh(float x){float r=($exp(x)-$exp(-x))*0.5,u=sinh(x);return $has(4)?r:u;}
float $cosh(float x){float r=($exp(x)+$exp(-x))*0.5,u=cosh(x);return $has(4)?r:u;}
float $tanh(float x){float a=$exp(x),b=$exp(-x),r=(a-b)/(a+b),u=tanh(x);return $has(4)?r:u;}
float $hidden(float v){return $bits($bits(v)^($mode>>20));}
float $zero(float a,float b){if($has(16))b=$hidden(b);else return $has(8)?float(double(a)/double(b)):a/b;
return $has(8)?float(double(a)/double(b)):a/b;}
float $divide(float a,float b){float s=float(double(a)/double(b)),q=a/b;q=$has(8)?s:q;if(b==0.0)q=$zero(a,b);return q;}
float $over(float a,float b){precise float r=1.0/b,q=a*r;float u=a/b;q=$has(8)?q:u;if(b==0.0)q=$zero(a,b);return q;}
float $mod(float x,float y){float h=$hidden(y),u=mod(x,y);precise float r=x-h*floor($divide(x,h));
return $has(y==0.0?16:8)?r:u;}
float $smoothstep(float a,float b,float x){precise float d=x-a,e=b-a;float t=clamp($divide(d,e),0.0,1.0);
precise float r=t*t*(3.0-2.0*t);float u=smoothstep(a,b,x);return $has(8)?r:u;}
bool $odd(float x,float y){return max($bits(x)&0x7fffffff,$bits(y)&0x7fffffff)>0x7f800000;}
float $min(float x,float y){float u=min(x,y),r=x<y?x:y;r=$odd(x,y)?y:r;return $has(16)?r:u;}
float $max(float x,float y){float u=max(x,y),r=x>y?x:y;r=$odd(x,y)?y:r;return $has(16)?r:u;}
float $clamp(float x,float a,float b){float r=$min($max(x,a),b),u=clamp(x,a,b);return $has(16)?r:u;}
float $bound(float x,float a,float b){float r=$clamp(x,a,b);return $has(16)&&x<=a?a:r;}
vec3 $cross(vec3 a,vec3 b){precise vec3 r=a.yzx*b.zxy-b.yzx*a.zxy;vec3 u=cross(a,b);return $has(8)?r:u;}
mat2 $inverse(mat2 m){if(!$has(8))return inverse(m);precise float d=1.0/(m[0][0]*m[1][1]-m[0][1]*m[1][0]);
precise mat2 r=mat2(d*m[1][1],d*-m[0][1],d*-m[1][0],d*m[0][0]);return r;}
float $volume(vec3 a,vec3 b,vec3 c){
precise float r=a.x*b.y*c.z+a.y*b.z*c.x+a.z*b.x*c.y-a.z*b.y*c.x-a.y*b.x*c.z-a.x*b.z*c.y;return r;}
float $determinant(mat2 m){if(!$has(8))return determinant(m);
precise float r=m[0][0]*m[1][1]-m[0][1]*m[1][0];return r;}
float $determinant(mat3 m){return $has(8)?$volume(m[0],m[1],m[2]):determinant(m);}
float $determinant(mat4 m){if(!$has(8))return determinant(m);precise vec4 v=m[0]*vec4(
$volume(m[1].yzw,m[2].yzw,m[3].yzw),$volume(m[1].xzw,m[2].xzw,m[3].xzw),
$volume(m[1].xyw,m[2].xyw,m[3].xyw),$volume(m[1].xyz,m[2].xyz,m[3].xyz));
precise float r=v.x-v.y+v.z-v.w;return r;}
float $minor(vec3 v,vec3 a,vec3 b){precise vec3 m=v*(a.yxx*b.zzy-a.zzy*b.yxx);precise float r=m.x-m.y+m.z;return r;}
vec4 $minors(vec4 v,vec4 a,vec4 b,float s){return s*vec4($minor(v.yzw,a.yzw,b.yzw),
-$minor(v.xzw,a.xzw,b.xzw),$minor(v.xyw,a.xyw,b.xyw),-$minor(v.xyz,a.xyz,b.xyz));}
mat3 $inverse(mat3 m){if(!$has(8))return inverse(m);precise float s=1.0/$determinant(m);
return transpose(mat3(s*$cross(m[1],m[2]),s*$cross(m[2],m[0]),s*$cross(m[0],m[1])));}
mat4 $inverse(mat4 m){if(!$has(8))return inverse(m);precise float s=1.0/$determinant(m);
return transpose(mat4($minors(m[1],m[2],m[3],s),$minors(m[0],m[2],m[3],-s),
$minors(m[0],m[1],m[3],s),$minors(m[0],m[1],m[2],-s)));}
int $modulo(int a,int b){int d=b==0||b==-1?1:b,r=a-d*(a/d),s=r+b,u=a%b;
r=r!=0&&(r<0)!=(b<0)?s:r;return $has(16)?r:u;}
uint $modulo(uint a,uint b){uint r=a%0xffffffffu,u=a%b;return $has(16)&&b==0u?r:u;}
int $quotient(int a,int b){int n=-a,u=a/b;n=a==0x80000000?1:n;return $has(16)&&(b==0||b==-1)?n:u;}
uint $quotient(uint a,uint b){uint r=a/0xffffffffu,u=a/b;return $has(16)&&b==0u?r:u;}
uint $uint(float f){uint u=uint(f);return $has(16)&&!(f>=0.0&&f<4294967296.0)?0u:u;}
int $place(int i,int n){int c=clamp(i,0,n-1);return $has(16)?c:i;}
int $place(uint i,int n){int c=int(min(i,uint(n-1))),u=int(i);return $has(16)?c:u;}
float $fract(float x){float r=min(x-floor(x),0.99999994),u=fract(x);return $has(8)?r:u;}
float $mix(float x,float y,float a){precise float r=a*(y-x)+x;float u=mix(x,y,a);return $has(8)?r:u;}
float $mix(float x,float y,bool a){return a?y:x;}bool $even(float at){return (int(at)&1)==0;}
float $levels(float q,float by){q*=q;return (float($bits(q))-float(0x3f800000))*by*5.9604644775390625e-8;}
float $across(float v){v=dFdxFine(v);v=$even(gl_FragCoord.y)?v:0.0;return -dFdyFine(v);}
float $upwards(float v){v=dFdyFine(v);v=$even(gl_FragCoord.x)?v:0.0;return -dFdxFine(v);}
float $dFdx(float v){float r=$across(v),u=dFdx(v);return $has(128)?r:u;}
float $dFdy(float v){float r=$upwards(v),u=dFdy(v);return $has(128)?r:u;}
float $fwidth(float v){float r=abs($across(v))+abs($upwards(v)),u=fwidth(v);return $has(128)?r:u;}
float $flag[2]=float[2](0.0,0.0);bool $live(){int a=$mode>>20,b=$mode>>21;$flag[a]=1.0;float f=$flag[b];$flag[a]=0.0;
return f==1.0;}bool $gone(){bool outside=$has(16),live=$live();return outside&&!live;}
float $kept(float v){return $gone()?0.0:v;}int $kept(int v){return $gone()?0:v;}uint $kept(uint v){return $gone()?0u:v;}
float $dot(float a,float b){return a*b;}float $length(float v){return abs(v);}
float $distance(float a,float b){return abs(a-b);}
float $normalize(float v){return normalize(v);}float $reflect(float i,float n){return reflect(i,n);}
)";

/// One for each size @ of vectors.
constexpr std::string_view k_swift_vectors = R"(@ $kept(@ v){@ none=@(0.0);return $gone()?none:v;}
@ $mix(@ x,@ y,@ a){
precise @ r=a*(y-x)+x;@ u=mix(x,y,a);return $has(8)?r:u;}
@ $divide(@ a,float b){return $divide(a,@(b));}@ $divide(float a,@ b){return $divide(@(a),b);}
@ $min(@ a,float b){return $min(a,@(b));}@ $max(@ a,float b){return $max(a,@(b));}
@ $clamp(@ x,float a,float b){return $clamp(x,@(a),@(b));}
@ $over(@ a,float b){precise float r=1.0/b;precise @ q=a*r;@ u=a/b,z=$divide(a,b);q=$has(8)?q:u;return b==0.0?z:q;}
@ $over(@ a,@ b){bool none=any(equal(b,@(0.0)));precise @ r=1.0/b,q=a*r;@ u=a/b,z=$divide(a,b);
q=$has(8)?q:u;return none?z:q;}
@ $over(float a,@ b){return $over(@(a),b);}@ $mod(@ a,float b){return $mod(a,@(b));}
@ $smoothstep(float a,float b,@ x){return $smoothstep(@(a),@(b),x);}
@ $mix(@ x,@ y,float a){@ r=$mix(x,y,@(a)),u=mix(x,y,a);return $has(8)?r:u;}
float $length(@ v){float r=sqrt($dot(v,v)),u=length(v);return $has(8)?r:u;}
float $distance(@ a,@ b){precise @ d=a-b,s=d*d;precise float r=s[0];for(int i=1;i<s.length();++i)r+=s[i];
r=sqrt(r);float u=distance(a,b);return $has(8)?r:u;}
@ $normalize(@ v){@ r=(1.0/sqrt($dot(v,v)))*v,u=normalize(v);return $has(8)?r:u;}
u@ $u@(@ f){u@ r;for(int i=0;i<f.length();++i)r[i]=$uint(f[i]);return r;}
@ $reflect(@ i,@ n){precise @ r=i-(2.0*$dot(i,n))*n;@ u=reflect(i,n);return $has(8)?r:u;}
)";

/// Look-ups, for each kind of sampler: `@` is the type of coordinates. Bytes are filtered as numbers up to
/// 65280; a nearest one is found with 16 bits of the coordinate, cut off towards zero. llvmpipe's textureSize
/// ignores that pixels may ask for different levels.
constexpr std::string_view k_swift_lookup = R"(
vec4 $level(S s,@ p,float l,out float by){@ n=@(max(textureSize(s,0)>>int(l),1)),e=floor(p);
precise @ at=(p-e)*n-0.5;@ low=floor(at),f=at-low;vec4 t[C];bool bytes=true;
for(int i=0;i<C;++i){t[i]=textureLod(s,(low+@(i&1,(i>>1)&1 T)+0.5)/n+e,l);
vec4 b=t[i]*255.0;bytes=bytes&&all(lessThan(abs(b-roundEven(b)),vec4(1e-3)));}
if(bytes)for(int i=0;i<C;++i)t[i]=roundEven(t[i]*255.0)*256.0;by=bytes?1.0/65280.0:1.0;
for(int k=C/2,a=0;k>0;k/=2,++a)for(int i=0;i<k;++i){
precise vec4 r=t[2*i]+f[a]*(t[2*i+1]-t[2*i]);t[i]=r;}return t[0];}
vec4 $mips(S s,@ p,float l){float top=float(textureQueryLevels(s)-1);l=clamp(l,0.0,top);float i=floor(l);
vec4 own=textureLod(s,p,i);if(!$has(64))return l==i?own:mix(own,textureLod(s,p,i+1.0),l-i);
float by,other=1.0;vec4 a=$level(s,p,i,by),b=l==i?a:$level(s,p,i+1.0,other);
precise vec4 r=(b-a)*(l-i)+a;r=l==i||by==other?r*by:mix(a*by,b*other,l-i);
i@ n=max(textureSize(s,0)>>int(i),1),q=i@(p*65536.0);vec4 nearest=textureLod(s,(floor(p*@(n))+0.5)/@(n),i);
vec4 found=textureLod(s,(@((q&65535)*n>>16)+0.5)/@(n)+@(q>>16),i);found=by<1.0?found:own;
return l==i&&own==nearest&&any(greaterThan(abs(own-r),vec4(0.01)))?found:r;}
vec4 $texture(S s,@ p,float b){if(!$has(96))return texture(s,p,b);
@ n=@(textureSize(s,0)),x=$across(p)*n,y=$upwards(p)*n;
return $mips(s,p,$levels(max(dot(x,x),dot(y,y)),0.5)+b);}
vec4 $texture(S s,@ p){return $has(96)?$texture(s,p,0.0):texture(s,p);}
vec4 $textureLod(S s,@ p,float l){return $has(96)?$mips(s,p,l):textureLod(s,p,l);}
)";

constexpr std::string_view k_swift_cube = R"(vec4 $mips(samplerCube s,vec3 p,float l){
l=clamp(l,0.0,float(textureQueryLevels(s)-1));float i=floor(l);vec4 a=textureLod(s,p,i);
return l==i?a:mix(a,textureLod(s,p,i+1.0),l-i);}
vec4 $texture(samplerCube s,vec3 p,float b){if(!$has(32))return texture(s,p,b);
vec3 u=p*(0.5/max(max(abs(p.x),abs(p.y)),abs(p.z))),x=abs($across(u)),y=abs($upwards(u));
float q=max(x.x+x.y+x.z-min(min(x.x,x.y),x.z),y.x+y.y+y.z-min(min(y.x,y.y),y.z));
return $mips(s,p,$levels(q*float(textureSize(s,0).x),1.0)+b);}
vec4 $texture(samplerCube s,vec3 p){return $has(32)?$texture(s,p,0.0):texture(s,p);}
vec4 $textureLod(samplerCube s,vec3 p,float l){return $has(32)?$mips(s,p,l):textureLod(s,p,l);}
)";

struct SwiftFunction {
    std::string_view name;
    int parts;         ///< bits of SwiftShaderPart that change it
    int arguments = 0; ///< of a function that works on each component; 0: the prelude has its overloads
};

using enum SwiftShaderPart;
constexpr SwiftFunction k_swift_functions[] = {
    {"sin", int(sines), 1},
    {"cos", int(sines), 1},
    {"tan", int(sines), 1},
    {"asin", int(arcs), 1},
    {"acos", int(arcs), 1},
    {"atan", int(arcs) | int(outside), 2},
    {"exp", int(powers), 1},
    {"exp2", int(powers), 1},
    {"log", int(powers) | int(outside), 1},
    {"log2", int(powers) | int(outside), 1},
    {"pow", int(powers) | int(outside), 2},
    {"sinh", int(powers), 1},
    {"cosh", int(powers), 1},
    {"tanh", int(powers), 1},
    {"fract", int(products), 1},
    {"divide", int(products) | int(outside), 2}, // of the operator, too
    {"mod", int(products) | int(outside), 2},
    {"smoothstep", int(products), 3},
    {"min", int(outside), 2},
    {"max", int(outside), 2},
    {"clamp", int(outside), 3},
    {"dFdx", int(derivatives), 1},
    {"dFdy", int(derivatives), 1},
    {"fwidth", int(derivatives), 1},
    {"inverse", int(products)},
    {"determinant", int(products)},
    {"mix", int(products)},
    {"dot", int(products)},
    {"cross", int(products)},
    {"length", int(products)},
    {"distance", int(products)},
    {"normalize", int(products)},
    {"reflect", int(products)},
    {"texture", int(mipmaps) | int(weights)},
    {"textureLod", int(mipmaps) | int(weights)},
    {"uint", int(outside)}, // of floats
    {"uvec2", int(outside)},
    {"uvec3", int(outside)},
    {"uvec4", int(outside)},
};

std::string replaced(std::string text, std::string_view what, std::string_view with) {
    for (size_t at = text.find(what); at != text.npos; at = text.find(what, at + with.size()))
        text.replace(at, what.size(), with);
    return text;
}

/// Returns overloads for vectors of functions that work on each component, and of those that do not.
std::string swift_overloads() {
    std::string text;
    const auto each = [&](std::string_view name, int size, int arguments) {
        std::string parts;
        for (int i = 0; i < size; ++i)
            parts += fmt::format("{}${}(u[{}]{})", i > 0 ? "," : "", name, i,
                                 arguments == 1   ? ""
                                 : arguments == 2 ? fmt::format(",v[{}]", i)
                                                  : fmt::format(",v[{0}],w[{0}]", i));
        text += fmt::format("vec{0} ${1}(vec{0} u{2}){{return vec{0}({3});}}\n", size, name,
                            arguments == 1   ? ""
                            : arguments == 2 ? fmt::format(",vec{} v", size)
                                             : fmt::format(",vec{0} v,vec{0} w", size),
                            parts);
    };
    for (int size = 2; size <= 4; ++size) {
        for (const SwiftFunction& function : k_swift_functions)
            if (function.arguments > 0) {
                each(function.name, size, function.arguments);
                if (function.name == "atan")
                    each(function.name, size, 1);
            }
        each("across", size, 1);
        each("upwards", size, 1);
        std::string chain = "a[0]*b[0]", parts;
        for (int i = 1; i < size; ++i)
            chain = fmt::format("$fma(a[{0}],b[{0}],{1})", i, chain);
        for (int i = 0; i < size; ++i)
            parts += fmt::format("{0}a[{1}]?y[{1}]:x[{1}]", i > 0 ? "," : "", i);
        text += fmt::format("float $dot(vec{0} a,vec{0} b){{float r={1},u=dot(a,b);return $has(8)?r:u;}}\n"
                            "vec{0} $mix(vec{0} x,vec{0} y,bvec{0} a){{return vec{0}({2});}}\n",
                            size, chain, parts) +
                replaced(std::string(k_swift_vectors), "@", fmt::format("vec{}", size));
    }
    return text;
}

/// Returns functions that take whole numbers, too.
std::string swift_whole_overloads() {
    std::string text;
    for (const std::string_view type : k_whole_vectors.first<8>()) {
        const std::string_view one = type.find('u') != type.npos ? "uint" : "int";
        for (const std::string_view name : {"min", "max"})
            text +=
                fmt::format("{0} ${2}({0} a,{0} b){{return {2}(a,b);}}\n", type, one, name) +
                (type == one ? ""
                             : fmt::format("{0} ${2}({0} a,{1} b){{return {2}(a,b);}}\n", type, one, name));
        for (const std::string_view name : {"modulo", "quotient"})
            if (type != one) {
                text += fmt::format("{0} ${1}({0} a,{0} b){{{0} r;"
                                    "for(int i=0;i<a.length();++i)r[i]=${1}(a[i],b[i]);return r;}}\n",
                                    type, name);
                text += fmt::format("{0} ${2}({0} a,{1} b){{return ${2}(a,{0}(b));}}\n"
                                    "{0} ${2}({1} a,{0} b){{return ${2}({0}(a),b);}}\n",
                                    type, one, name);
            }
        text +=
            fmt::format("{0} $clamp({0} x,{0} a,{0} b){{return clamp(x,a,b);}}\n", type) +
            (type == one ? ""
                         : fmt::format("{0} $clamp({0} x,{1} a,{1} b){{return clamp(x,a,b);}}\n", type, one));
    }
    return text;
}

/// Returns the products of matrices and vectors: each number a chain of multiply-adds, both rounded.
std::string swift_matrices() {
    std::string text;
    for (int columns = 2; columns <= 4; ++columns)
        for (int rows = 2; rows <= 4; ++rows) {
            std::string left, right;
            for (int row = 0; row < rows; ++row) {
                std::string chain = fmt::format("m[0][{0}]*v[0]", row);
                for (int i = 1; i < columns; ++i)
                    chain = fmt::format("$fma(m[{0}][{1}],v[{0}],{2})", i, row, chain);
                left += (row > 0 ? "," : "") + chain;
            }
            for (int column = 0; column < columns; ++column)
                right += fmt::format("{}$dot(v,m[{}])", column > 0 ? "," : "", column);
            const std::string matrix = fmt::format("mat{}x{}", columns, rows);
            text += fmt::format(
                "vec{2} $times({0} m,vec{1} v){{vec{2} r=vec{2}({3}),u=m*v;return $has(8)?r:u;}}\n"
                "vec{1} $times(vec{2} v,{0} m){{vec{1} r=vec{1}({4}),u=v*m;return $has(8)?r:u;}}\n"
                "{0} $times({0} m,float f){{return m*f;}}\n"
                "{0} $times(float f,{0} m){{return f*m;}}\n",
                matrix, columns, rows, left, right);
        }
    for (int columns = 2; columns <= 4; ++columns) // after the products with vectors, which these use
        for (int rows = 2; rows <= 4; ++rows)
            for (int others = 2; others <= 4; ++others) {
                std::string parts;
                for (int i = 0; i < others; ++i)
                    parts += fmt::format("{}$times(m,n[{}])", i > 0 ? "," : "", i);
                text +=
                    fmt::format("mat{2}x{1} $times(mat{0}x{1} m,mat{2}x{0} n){{return mat{2}x{1}({3});}}\n",
                                columns, rows, others, parts);
            }
    return text;
}

std::string swift_lookups() {
    const auto of = [](std::string_view sampler, std::string_view type, std::string_view corners,
                       std::string_view third) {
        std::string text(k_swift_lookup);
        text = replaced(text, "S s", fmt::format("{} s", sampler));
        text = replaced(text, " T)", fmt::format("{})", third));
        for (const char before : {'[', '<', '='})
            text = replaced(text, fmt::format("{}C", before), fmt::format("{}{}", before, corners));
        return replaced(text, "@", type);
    };
    return of("sampler2D", "vec2", "4", "") + of("sampler3D", "vec3", "8", ",i>>2") +
           std::string(k_swift_cube);
}

const SwiftFunction* swift_function(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    const std::string_view name =
        text.tree()[id].kind == NodeKind::call ? called_name(text, id) : std::string_view{};
    const auto found = std::ranges::find(k_swift_functions, name, &SwiftFunction::name);
    if (found == std::end(k_swift_functions) || facts.function(name))
        return nullptr;
    if (const auto made = value_type(name); made && made->base == 'u') { // a conversion
        const auto from = expression_type(text, facts, text.tree().child(id, 1));
        return from == ValueType{'f', made->columns, made->rows} ? found : nullptr;
    }
    return found;
}

/// Returns whether the expression has no side effects and is short enough to be repeated.
bool is_repeatable(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    const SyntaxTree& tree = text.tree();
    switch (tree[id].kind) {
    case NodeKind::name: return !facts.is_type(text.word_of(id));
    case NodeKind::member: return is_repeatable(text, facts, tree.child(id, 0));
    case NodeKind::index: {
        const NodeKind index = tree[tree.child(id, 1)].kind;
        return (index == NodeKind::name || index == NodeKind::literal) &&
               is_repeatable(text, facts, tree.child(id, 0));
    }
    default: return false;
    }
}

/// Returns whether the node reads or writes an element whose number is known only at run time. Chromium keeps
/// such a number within the array, vector or matrix.
bool is_element(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind != NodeKind::index || tree.around(id, NodeKind::function) == k_no_node)
        return false;
    const NodeId number = tree.child(id, 1);
    if (number == k_no_node || tree[number].kind == NodeKind::literal ||
        !is_repeatable(text, facts, tree.child(id, 0)))
        return false;
    const auto type = expression_type(text, facts, number);
    return type && type->scalar() && (type->base == 'i' || type->base == 'u');
}

/// Returns whether the node, a number or a vector of floats, is only read.
bool is_read(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    const SyntaxTree& tree = text.tree();
    const auto type = expression_type(text, facts, id);
    if (!type || type->matrix() ||
        (type->base != 'f' && !(type->scalar() && (type->base == 'i' || type->base == 'u'))))
        return false;
    NodeId whole = id;
    while (tree[tree[whole].parent].kind == NodeKind::member ||
           tree[tree[whole].parent].kind == NodeKind::index)
        whole = tree[whole].parent;
    const NodeId use = tree[whole].parent;
    return is_change(text, use) ? tree.child(use, 0) != whole : names_set(text, facts, use).empty();
}

/// Returns the function of the prelude for a product of a matrix, a quotient or a remainder; empty for other
/// nodes. `known` may be null: `divide` then stands for `over`, too.
std::string_view swift_operator(const ParsedText& text, const TreeFacts& facts,
                                const std::vector<bool>* known, NodeId id) {
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind != NodeKind::binary && tree[id].kind != NodeKind::assign)
        return {};
    const std::string_view word = text.word_of(id);
    const bool times = word == "*" || word == "*=";
    const bool modulo = word == "%" || word == "%=";
    if (!times && !modulo && word != "/" && word != "/=")
        return {};
    const auto left = expression_type(text, facts, tree.child(id, 0));
    const auto right = expression_type(text, facts, tree.child(id, 1));
    if (left && right && left->base == right->base && (left->base == 'i' || left->base == 'u')) {
        if (modulo)
            return "modulo";
        return times || tree[without_brackets(tree, tree.child(id, 1))].kind == NodeKind::literal
                   ? std::string_view{}
                   : "quotient";
    }
    if (modulo)
        return {};
    if (!left || !right || left->base != 'f' || right->base != 'f')
        return {};
    if (left->matrix() || right->matrix())
        return times ? "times" : std::string_view{};
    if (times)
        return {};
    if (!known || !(*known)[tree.child(id, 1)])
        return "divide";
    // By a known number: times its reciprocal, which both compilers merge with a factor.
    const auto has_factor = [&](NodeId product) {
        return tree[product].kind == NodeKind::binary && text.word_of(product) == "*" &&
               ((*known)[tree.child(product, 0)] || (*known)[tree.child(product, 1)]);
    };
    const NodeId divisor = without_brackets(tree, tree.child(id, 1)), dividend = tree.child(id, 0);
    const bool is_number = tree[divisor].kind == NodeKind::literal &&
                           text.word_of(divisor).find_first_of("123456789") != std::string_view::npos;
    return left->scalar() && is_number &&
                   (has_factor(without_brackets(tree, dividend)) || has_factor(tree[id].parent))
               ? std::string_view{}
               : "over";
}

int operator_parts(std::string_view name) {
    if (name == "modulo" || name == "quotient")
        return int(outside);
    return int(products) | (name == "times" ? 0 : int(outside)); // by zero
}

/// Returns whether the value and the lower bound of a `clamp` are known. The compiler ignores the upper one.
bool is_known_below(const ParsedText& text, const TreeFacts& facts, const std::vector<bool>& known,
                    NodeId id) {
    const auto type = expression_type(text, facts, id);
    return type && type->scalar() && called_name(text, id) == "clamp" && known[text.tree().child(id, 1)] &&
           known[text.tree().child(id, 2)];
}

} // namespace

Variation vary_like_swiftshader(const ParsedText& text, const TreeFacts& facts, int parts, bool precise,
                                const MayVary& may) {
    const SyntaxTree& tree = text.tree();
    const std::string prefix = fresh_prefix(text);
    const bool by_lines = bool(may);
    Variation result{{}, prefix + "mode", {}};
    SourceRewriter edits(text);
    const std::vector<bool> known = find_known(text, facts, KnownTo::swiftshader);
    const std::vector<NodeId> early = early_reads(text, facts);
    std::string copies; ///< variables that keep what is read early
    int all_parts = 0;  // of the text
    for (NodeId id = 1; id < tree.nodes.size(); ++id)
        if (const SwiftFunction* const function = swift_function(text, facts, id))
            all_parts |= function->parts;
    bool has_lookup = false, has_matrix = false;
    for (NodeId id = 1; id < tree.nodes.size(); ++id) {
        if (precise && tree[id].kind == NodeKind::declaration &&
            tree.around(id, NodeKind::function) != k_no_node) {
            const NodeId type = tree.child(id, 0);
            if (class_of_type(type_name(text, type)) == TypeClass::floating &&
                !has_qualifier(text, type, "const") && !has_qualifier(text, type, "precise"))
                edits.wrap(type, "precise ", "");
        }
        if ((by_lines && !may(id)) || must_stay_constant(text, id) || known[id])
            continue;
        bool varied = true;
        if (const SwiftFunction* const function = swift_function(text, facts, id);
            function && (function->parts & parts) != 0) {
            has_lookup = has_lookup || (function->parts & (int(mipmaps) | int(weights))) != 0;
            const auto name = is_known_below(text, facts, known, id) ? "bound" : function->name;
            edits.replace(tree[tree.child(id, 0)].word, prefix + std::string(name));
        } else if (const auto name = swift_operator(text, facts, &known, id);
                   !name.empty() && (parts & operator_parts(name)) != 0) {
            has_matrix = has_matrix || name == "times";
            edits.wrap(id, prefix + std::string(name) + "(", ")");
            if (tree[id].kind == NodeKind::binary) {
                edits.replace(tree[id].word, ",");
            } else {
                const std::string target = words_of(text, tree.child(id, 0));
                edits.wrap(id, "(" + target + "=", ")");
                edits.replace(tree[id].word, ",");
            }
        } else if ((parts & int(outside)) != 0 && is_element(text, facts, id)) {
            if ((all_parts & (int(mipmaps) | int(derivatives))) != 0 && is_read(text, facts, id))
                edits.wrap(id, prefix + "kept(", ")");
            edits.wrap(tree.child(id, 1), prefix + "place(",
                       fmt::format(",({}).length())", words_of(text, tree.child(id, 0))));
        } else {
            varied = false;
        }
        if ((parts & int(order)) != 0 && std::ranges::binary_search(early, id)) {
            const std::string copy = fmt::format("{}early{}", prefix, id);
            copies += fmt::format("{} {};\n", to_string(*expression_type(text, facts, id)), copy);
            edits.wrap(id, fmt::format("({}=", copy), ")");
            varied = true;
        }
        if (varied)
            result.places.push_back(id);
    }
    std::string prelude =
        "#extension GL_ARB_gpu_shader5 : enable\n#extension GL_ARB_gpu_shader_fp64 : enable\n"
        "#extension GL_ARB_derivative_control : enable\n"
        "#extension GL_ARB_texture_query_levels : enable\n";
    prelude += spell(std::string(k_swift_numbers), prefix);
    prelude += replaced(swift_overloads() + swift_whole_overloads(), "$", prefix);
    if (has_matrix)
        prelude += replaced(swift_matrices(), "$", prefix);
    if (has_lookup)
        prelude += replaced(swift_lookups(), "$", prefix);
    result.text = headers_with_buffers(text) + prelude + copies + edits.text();
    return result;
}

std::vector<int> swiftshader_parts(const ParsedText& text, const TreeFacts& facts) {
    std::vector<int> result(text.tree().nodes.size());
    for (NodeId id = 1; id < result.size(); ++id) {
        const std::string_view name = swift_operator(text, facts, nullptr, id);
        if (const SwiftFunction* const function = swift_function(text, facts, id))
            result[id] = function->parts;
        else if (is_element(text, facts, id))
            result[id] = int(outside);
        else if (!name.empty())
            result[id] = operator_parts(name);
    }
    for (const NodeId id : early_reads(text, facts))
        result[id] |= int(order);
    return result;
}

} // namespace tidemark::glsl
