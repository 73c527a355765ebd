void mainImage(out vec4 O,vec2 U){vec3 p,R=iResolution;float i,d=1.,t=0.;for(O-=O;i++<30.&&d>.01;t+=d)p=vec3((U+U-R.xy)/R.y*t,t-4.),d=length(p)-1.;O+=d<.1?.5+.5*p.yyyy:O;}
