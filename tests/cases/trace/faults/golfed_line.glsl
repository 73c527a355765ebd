void mainImage(out vec4 O, vec2 U){vec2 R=iResolution.xy;float i=0.,z=0.;for(O*=0.;i++<9.;O+=.1/z)z=dot(U/R,R-R);O=O+sqrt(z-1.);} // born +Inf: division by zero; column 94; cures column 118
