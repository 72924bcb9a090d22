/* film_page.c -- the page that plays a film: markup and script, no libraries; the data D come between the two.
 *
 * A canvas, triangles and lines sorted by depth.  Dragging turns, with shift moves, the wheel zooms; #t=0.5 behind the
 * address stands still at that time. */
#include "film/film_page.h"

#include <stddef.h>

const char *const film_page_before[] = {
    "<!doctype html>\n",
    "<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">\n",
    "<style>\n",
    "html,body{margin:0;height:100%;font:14px system-ui,sans-serif;color:#222;background:#fff}\n",
    "body{display:flex;flex-direction:column}\n",
    "h1{font-size:16px;margin:8px 12px 0}\n",
    "#main{flex:1;display:flex;min-height:0}\n",
    "#view{flex:1;min-width:0;touch-action:none;cursor:grab}\n",
    "#side{width:320px;overflow:auto;border-left:1px solid #ddd;padding:0 8px}\n",
    "#side canvas{width:100%;height:110px;display:block}\n",
    "#side p{margin:8px 0 0;font-size:12px}\n",
    "#bar{display:flex;gap:10px;align-items:center;padding:8px 12px;border-top:1px solid #ddd}\n",
    "#bar input{flex:1}\n",
    "button,select{font:inherit;padding:3px 10px}\n",
    "</style></head><body>\n",
    "<h1 id=\"title\"></h1>\n",
    "<div id=\"main\"><canvas id=\"view\"></canvas><div id=\"side\"></div></div>\n",
    "<div id=\"bar\"><button id=\"play\">Pause</button><input id=\"slide\" type=\"range\" min=\"0\" max=\"1000\" "
    "value=\"0\" aria-label=\"time\">\n",
    "<span id=\"time\"></span><select id=\"speed\" aria-label=\"speed\"></select><button id=\"home\">Whole "
    "view</button></div>\n",
    "<script>\n",
    NULL,
};

const char *const film_page_behind[] = {
    "const $=i=>document.getElementById(i),T=D.t,N=T.length,t0=T[0],t1=T[N-1],span=t1-t0||1;\n",
    "document.title=D.title;$(\"title\").textContent=D.title;\n",
    "const view=$(\"view\"),g=view.getContext(\"2d\");\n",
    "let yaw,pitch,zoom,px,py,now=t0,playing=!location.hash.includes(\"t=\"),speed,dirty=true;\n",
    "const mid=[0,1,2].map(k=>(D.low[k]+D.high[k])/2);\n",
    "const box=Math.max(Math.hypot(...[0,1,2].map(k=>D.high[k]-D.low[k])),D.size*.5);\n",
    "function home(){yaw=D.space===3?-.6:0;pitch=D.space===3?-1.15:0;zoom=1;px=py=0;dirty=true}\n",
    "home();\n",
    "const usual=span>=2&&span<=30?1:span/8;\n",
    "for(const f of [.05,.1,.25,.5,1,2,5,10]){const o=document.createElement(\"option\");o.value=f*usual;\n",
    "o.textContent=usual===1?f+\" x\":\"1 s = \"+(f*usual).toPrecision(2)+\" "
    "s\";o.selected=f===1;$(\"speed\").append(o)}\n",
    "speed=usual;$(\"speed\").onchange=e=>speed=+e.target.value;\n",
    "function find(t){let a=0,b=N-1;while(b-a>1){const m=a+b>>1;T[m]<=t?a=m:b=m}\n",
    "const h=T[b]-T[a];return[a,b,h>0?Math.min(1,Math.max(0,(t-T[a])/h)):0]}\n",
    "function state(p,n,at){const[a,b,s]=at,o=new Array(n);for(let i=0;i<n;i++)o[i]=p[a*n+i]*(1-s)+p[b*n+i]*s;return "
    "o}\n",
    "function turn(q){const l=Math.hypot(q[3],q[4],q[5],q[6])||1,w=q[3]/l,x=q[4]/l,y=q[5]/l,z=q[6]/l;\n",
    "return[1-2*(y*y+z*z),2*(x*y-w*z),2*(x*z+w*y),2*(x*y+w*z),1-2*(x*x+z*z),2*(y*z-w*x),2*(x*z-w*y),2*(y*z+w*x),1-2*(x*"
    "x+y*y)]}\n",
    "function "
    "place(R,r,x,y,z){return[r[0]+R[0]*x+R[1]*y+R[2]*z,r[1]+R[3]*x+R[4]*y+R[5]*z,r[2]+R[6]*x+R[7]*y+R[8]*z]}\n",
    "let W,H,S,cy,sy,cp,sp;\n",
    "function camera(){const d=devicePixelRatio||1,w=view.clientWidth,h=view.clientHeight;\n",
    "if(view.width!==Math.round(w*d)||view.height!==Math.round(h*d)){view.width=Math.round(w*d);view.height=Math.round("
    "h*d)}\n",
    "W=view.width;H=view.height;S=.86*Math.min(W,H)/box*zoom;\n",
    "if(D.space===2&&zoom===1){const "
    "a=D.high[0]-D.low[0]+.1*D.size,b=D.high[1]-D.low[1]+.1*D.size;S=.9*Math.min(W/a,H/b)}\n",
    "else if(D.space===2){const "
    "a=D.high[0]-D.low[0]+.1*D.size,b=D.high[1]-D.low[1]+.1*D.size;S=.9*Math.min(W/a,H/b)*zoom}\n",
    "cy=Math.cos(yaw);sy=Math.sin(yaw);cp=Math.cos(pitch);sp=Math.sin(pitch)}\n",
    "function eye(p){const x=p[0]-mid[0],y=p[1]-mid[1],z=p[2]-mid[2],a=cy*x-sy*y,b=sy*x+cy*y;\n",
    "return[W/2+px*W+S*a,H/2+py*H-S*(cp*b-sp*z),sp*b+cp*z]}\n",
    "function shade(c,l){const "
    "f=.45+.55*l;return\"rgb(\"+[c>>16,c>>8&255,c&255].map(v=>Math.round(v*f+(255-255*1)*0)).join()+\")\"}\n",
    "function hot(s){const "
    "a=[[59,115,185],[90,170,120],[230,190,70],[200,60,50]],k=Math.min(2.999,Math.max(0,s)*3),i=k|0,f=k-i;\n",
    "return\"rgb(\"+[0,1,2].map(j=>Math.round(a[i][j]*(1-f)+a[i+1][j]*f)).join()+\")\"}\n",
    "function grid(out){const big=Math.pow(10,Math.floor(Math.log10(box/2))),n=Math.ceil(box/big);\n",
    "const "
    "z=D.space===3?D.low[2]-.03*D.size:-.06*D.size,x0=Math.round(mid[0]/big)*big,y0=Math.round(mid[1]/big)*big;\n",
    "g.strokeStyle=\"#e6e6e6\";g.lineWidth=1;g.beginPath();\n",
    "for(let "
    "i=-n;i<=n;i++){for(const[a,b]of[[[x0+i*big,y0-n*big,z],[x0+i*big,y0+n*big,z]],[[x0-n*big,y0+i*big,z],[x0+n*big,y0+"
    "i*big,z]]]){\n",
    "const u=eye(a),v=eye(b);g.moveTo(u[0],u[1]);g.lineTo(v[0],v[1])}}g.stroke();\n",
    "g.fillStyle=\"#888\";g.font=12*(devicePixelRatio||1)+\"px sans-serif\";g.fillText(\"grid "
    "\"+(+big.toPrecision(3))+\" m\",10,H-10)}\n",
    "const peak=D.actors.map(a=>{let m=0;if(a.k!==\"line\")return 0;for(let f=0;f<N;f++)for(let v=0;v<a.nv;v++){let "
    "u=[0,0,0];\n",
    "for(let j=0;j<a.n;j++)for(let "
    "k=0;k<3;k++)u[k]+=a.p[f*(7+a.n)+7+j]*a.m[3*(j*a.nv+v)+k];m=Math.max(m,Math.hypot(...u))}return m});\n",
    "function draw(){camera();g.setTransform(1,0,0,1,0,0);g.fillStyle=\"#fff\";g.fillRect(0,0,W,H);grid();\n",
    "const at=find(now),out=[];\n",
    "D.actors.forEach((a,i)=>{\n",
    "if(a.k===\"solid\"){const q=state(a.p,7,at),R=turn(q),v=[];\n",
    "for(let k=0;k<a.x.length;k+=3)v.push(place(R,q,a.x[k],a.x[k+1],a.x[k+2]));\n",
    "const e=v.map(eye);\n",
    "for(let k=0;k<a.f.length;k+=3){const A=e[a.f[k]],B=e[a.f[k+1]],C=e[a.f[k+2]];\n",
    "const cr=(B[0]-A[0])*(C[1]-A[1])-(B[1]-A[1])*(C[0]-A[0]);if(cr>=0)continue;\n",
    "const ux=(B[0]-A[0])/S,uy=-(B[1]-A[1])/S,uz=B[2]-A[2],vx=(C[0]-A[0])/S,vy=-(C[1]-A[1])/S,vz=C[2]-A[2];\n",
    "const nx=uy*vz-uz*vy,ny=uz*vx-ux*vz,nz=ux*vy-uy*vx,l=Math.hypot(nx,ny,nz)||1;\n",
    "out.push([(A[2]+B[2]+C[2])/3,0,[A,B,C],shade(a.c,Math.max(0,(.3*nx+.5*ny+.8*nz)/l))])}}\n",
    "else if(a.k===\"line\"){const n=7+a.n,q=state(a.p,n,at),R=turn(q),v=[],s=[];\n",
    "for(let k=0;k<a.nv;k++){let u=[0,0,0];for(let j=0;j<a.n;j++)for(let "
    "c=0;c<3;c++)u[c]+=q[7+j]*a.m[3*(j*a.nv+k)+c];\n",
    "v.push(eye(place(R,q,a.x[3*k]+u[0],a.x[3*k+1]+u[1],a.x[3*k+2]+u[2])));s.push(peak[i]>0?Math.hypot(...u)/"
    "peak[i]:0)}\n",
    "for(let b=0;b+1<a.part.length;b++)for(let k=a.part[b];k+1<a.part[b+1];k++)\n",
    "out.push([(v[k][2]+v[k+1][2])/2,1,[v[k],v[k+1]],hot((s[k]+s[k+1])/2),.016*D.size*S])}\n",
    "else{const q=state(a.p,6,at),d=[0,1,2].map(k=>q[3+k]-q[k]),l=Math.hypot(...d)||1;\n",
    "let u=Math.abs(d[2])<.9*l?[d[1],-d[0],0]:[0,d[2],-d[1]];const "
    "m=Math.hypot(...u)||1;u=u.map(x=>x/m*.025*D.size);\n",
    "const z=a.coils?14:1,e=[];for(let k=0;k<=z;k++){const s=k/z,w=k===0||k===z||z===1?0:k%2?1:-1;\n",
    "e.push(eye([0,1,2].map(j=>q[j]+s*d[j]+w*u[j])))}\n",
    "for(let "
    "k=0;k<z;k++)out.push([(e[k][2]+e[k+1][2])/2,1,[e[k],e[k+1]],shade(a.c,1),(a.coils?.005:.014)*D.size*S])}});\n",
    "out.sort((a,b)=>a[0]-b[0]);g.lineCap=g.lineJoin=\"round\";\n",
    "for(const[,kind,p,c,w]of out){g.beginPath();g.moveTo(p[0][0],p[0][1]);for(let "
    "k=1;k<p.length;k++)g.lineTo(p[k][0],p[k][1]);\n",
    "if(kind){g.strokeStyle=c;g.lineWidth=Math.max(1.5,w);g.stroke()}else{g.closePath();g.fillStyle=g.strokeStyle=c;g."
    "lineWidth=.7;g.fill();g.stroke()}}\n",
    "curves(at)}\n",
    "const plots=D.columns.slice(0,12).map(c=>{const "
    "p=document.createElement(\"p\"),k=document.createElement(\"canvas\");$(\"side\").append(p,k);\n",
    "k.onpointerdown=k.onpointermove=e=>{if(e.type===\"pointermove\"&&!e.buttons)return;const "
    "r=k.getBoundingClientRect();\n",
    "set(t0+span*Math.min(1,Math.max(0,(e.clientX-r.left)/r.width)));stop()};\n",
    "let a=1/0,b=-1/0;for(const x of c.x)if(x!==null){a=Math.min(a,x);b=Math.max(b,x)}return{c,p,k,a,b}});\n",
    "if(!plots.length)$(\"side\").style.display=\"none\";\n",
    "function curves(at){for(const o of plots){const "
    "d=devicePixelRatio||1,w=o.k.width=o.k.clientWidth*d,h=o.k.height=110*d,c=o.k.getContext(\"2d\");\n",
    "const y=x=>o.b>o.a?h*.93-(x-o.a)/(o.b-o.a)*h*.86:h/2,x=t=>(t-t0)/span*w;\n",
    "c.strokeStyle=\"#ddd\";c.strokeRect(.5,.5,w-1,h-1);if(o.a<0&&o.b>0){c.beginPath();c.moveTo(0,y(0));c.lineTo(w,y(0)"
    ");c.stroke()}\n",
    "c.strokeStyle=\"#3b73b9\";c.lineWidth=1.4*d;c.beginPath();let pen=false;\n",
    "for(let i=0;i<N;i++){const "
    "v=o.c.x[i];if(v===null){pen=false;continue}pen?c.lineTo(x(T[i]),y(v)):c.moveTo(x(T[i]),y(v));pen=true}c.stroke();"
    "\n",
    "c.strokeStyle=\"#c33\";c.beginPath();c.moveTo(x(now),0);c.lineTo(x(now),h);c.stroke();\n",
    "const[i,j,s]=at,v=o.c.x[i]===null||o.c.x[j]===null?null:o.c.x[i]*(1-s)+o.c.x[j]*s;\n",
    "o.p.textContent=o.c.n+(o.c.u?\" [\"+o.c.u+\"]\":\"\")+\" = \"+(v===null?\"-\":v.toPrecision(5))}}\n",
    "function set(t){now=t;$(\"slide\").value=1000*(t-t0)/span;$(\"time\").textContent=\"t = "
    "\"+t.toFixed(span<1?4:3)+\" s\";dirty=true}\n",
    "function stop(){playing=false;$(\"play\").textContent=\"Play\"}\n",
    "$(\"play\").onclick=()=>{playing=!playing;if(playing&&now>=t1)set(t0);$(\"play\").textContent=playing?\"Pause\":"
    "\"Play\"};\n",
    "$(\"slide\").oninput=e=>{stop();set(t0+span*e.target.value/1000)};$(\"home\").onclick=home;\n",
    "let drag=null;\n",
    "view.onpointerdown=e=>{drag=[e.clientX,e.clientY,e.shiftKey||e.button===2||e.button===1];view.setPointerCapture(e."
    "pointerId)};\n",
    "view.onpointermove=e=>{if(!drag)return;const "
    "dx=e.clientX-drag[0],dy=e.clientY-drag[1];drag[0]=e.clientX;drag[1]=e.clientY;\n",
    "if(drag[2]){px+=dx/view.clientWidth;py+=dy/view.clientHeight}else{yaw+=dx*.008;pitch+=dy*.008}dirty=true};\n",
    "view.onpointerup=view.onpointercancel=()=>drag=null;view.oncontextmenu=e=>e.preventDefault();\n",
    "view.onwheel=e=>{e.preventDefault();zoom*=Math.exp(-e.deltaY*.0012);dirty=true};\n",
    "onresize=()=>dirty=true;\n",
    "onkeydown=e=>{if(e.target.tagName===\"SELECT\")return;if(e.key===\" "
    "\"){e.preventDefault();$(\"play\").onclick()}\n",
    "if(e.key===\"ArrowRight\"||e.key===\"ArrowLeft\"){const "
    "f=find(now)[0]+(e.key===\"ArrowRight\"?1:-1);stop();set(T[Math.min(N-1,Math.max(0,f))])}};\n",
    "const asked=/t=([-0-9.e]+)/.exec(location.hash);set(asked?+asked[1]:t0);if(!playing)stop();\n",
    "let before=null;\n",
    "function tick(ms){if(before!==null&&playing){let "
    "t=now+(ms-before)/1000*speed;if(t>t1)t=t0+(t-t0)%span;set(t)}before=ms;\n",
    "if(dirty){dirty=false;draw()}requestAnimationFrame(tick)}\n",
    "requestAnimationFrame(tick);\n",
    "</script></body></html>\n",
    NULL,
};
