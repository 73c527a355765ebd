#define mainImage(O,U) void mainImage(out vec4 O,vec2 U)
#define F(i) for(int i=0;i++<9;)
mainImage(O,U){O-=O;F(k)O+=.1/length(U/iResolution.y-1..xx);}
