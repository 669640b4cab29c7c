(()=>{var Mn=Uint8Array,ss=Uint16Array,bg=Int32Array,ad=new Mn([0,0,0,0,0,0,0,0,1,1,1,1,2,2,2,2,3,3,3,3,4,4,4,4,5,5,5,5,0,0,0,0]),ld=new Mn([0,0,0,0,1,1,2,2,3,3,4,4,5,5,6,6,7,7,8,8,9,9,10,10,11,11,12,12,13,13,0,0]),Sg=new Mn([16,17,18,0,8,7,9,6,10,5,11,4,12,3,13,2,14,1,15]),cd=function(i,t){for(var e=new ss(31),n=0;n<31;++n)e[n]=t+=1<<i[n-1];for(var s=new bg(e[30]),n=1;n<30;++n)for(var r=e[n];r<e[n+1];++r)s[r]=r-e[n]<<5|n;return{b:e,r:s}},hd=cd(ad,2),ud=hd.b,wg=hd.r;ud[28]=258,wg[258]=28;var dd=cd(ld,0),Tg=dd.b,O1=dd.r,xc=new ss(32768);for(ie=0;ie<32768;++ie)ti=(ie&43690)>>1|(ie&21845)<<1,ti=(ti&52428)>>2|(ti&13107)<<2,ti=(ti&61680)>>4|(ti&3855)<<4,xc[ie]=((ti&65280)>>8|(ti&255)<<8)>>1;var ti,ie,js=(function(i,t,e){for(var n=i.length,s=0,r=new ss(t);s<n;++s)i[s]&&++r[i[s]-1];var o=new ss(t);for(s=1;s<t;++s)o[s]=o[s-1]+r[s-1]<<1;var a;if(e){a=new ss(1<<t);var l=15-t;for(s=0;s<n;++s)if(i[s])for(var c=s<<4|i[s],h=t-i[s],u=o[i[s]-1]++<<h,d=u|(1<<h)-1;u<=d;++u)a[xc[u]>>l]=c}else for(a=new ss(n),s=0;s<n;++s)i[s]&&(a[s]=xc[o[i[s]-1]++]>>15-i[s]);return a}),Qs=new Mn(288);for(ie=0;ie<144;++ie)Qs[ie]=8;var ie;for(ie=144;ie<256;++ie)Qs[ie]=9;var ie;for(ie=256;ie<280;++ie)Qs[ie]=7;var ie;for(ie=280;ie<288;++ie)Qs[ie]=8;var ie,fd=new Mn(32);for(ie=0;ie<32;++ie)fd[ie]=5;var ie;var Eg=js(Qs,9,1);var Ag=js(fd,5,1),gc=function(i){for(var t=i[0],e=1;e<i.length;++e)i[e]>t&&(t=i[e]);return t},En=function(i,t,e){var n=t/8|0;return(i[n]|i[n+1]<<8)>>(t&7)&e},_c=function(i,t){var e=t/8|0;return(i[e]|i[e+1]<<8|i[e+2]<<16)>>(t&7)},Cg=function(i){return(i+7)/8|0},pd=function(i,t,e){return(t==null||t<0)&&(t=0),(e==null||e>i.length)&&(e=i.length),new Mn(i.subarray(t,e))};var Rg=["unexpected EOF","invalid block type","invalid length/literal","invalid distance","stream finished","no stream handler",,"no callback","invalid UTF-8 data","extra field too long","date not in range 1980-2099","filename too long","stream finishing","invalid zip data"],yn=function(i,t,e){var n=new Error(t||Rg[i]);if(n.code=i,Error.captureStackTrace&&Error.captureStackTrace(n,yn),!e)throw n;return n},Pg=function(i,t,e,n){var s=i.length,r=n?n.length:0;if(!s||t.f&&!t.l)return e||new Mn(0);var o=!e,a=o||t.i!=2,l=t.i;o&&(e=new Mn(s*3));var c=function(Pt){var te=e.length;if(Pt>te){var re=new Mn(Math.max(te*2,Pt));re.set(e),e=re}},h=t.f||0,u=t.p||0,d=t.b||0,f=t.l,m=t.d,x=t.m,p=t.n,g=s*8;do{if(!f){h=En(i,u,1);var S=En(i,u+1,3);if(u+=3,S)if(S==1)f=Eg,m=Ag,x=9,p=5;else if(S==2){var A=En(i,u,31)+257,_=En(i,u+10,15)+4,T=A+En(i,u+5,31)+1;u+=14;for(var F=new Mn(T),L=new Mn(19),N=0;N<_;++N)L[Sg[N]]=En(i,u+N*3,7);u+=_*3;for(var z=gc(L),Y=(1<<z)-1,I=js(L,z,1),N=0;N<T;){var X=I[En(i,u,Y)];u+=X&15;var w=X>>4;if(w<16)F[N++]=w;else{var $=0,V=0;for(w==16?(V=3+En(i,u,3),u+=2,$=F[N-1]):w==17?(V=3+En(i,u,7),u+=3):w==18&&(V=11+En(i,u,127),u+=7);V--;)F[N++]=$}}var it=F.subarray(0,A),W=F.subarray(A);x=gc(it),p=gc(W),f=js(it,x,1),m=js(W,p,1)}else yn(1);else{var w=Cg(u)+4,b=i[w-4]|i[w-3]<<8,C=w+b;if(C>s){l&&yn(0);break}a&&c(d+b),e.set(i.subarray(w,C),d),t.b=d+=b,t.p=u=C*8,t.f=h;continue}if(u>g){l&&yn(0);break}}a&&c(d+131072);for(var tt=(1<<x)-1,et=(1<<p)-1,Mt=u;;Mt=u){var $=f[_c(i,u)&tt],It=$>>4;if(u+=$&15,u>g){l&&yn(0);break}if($||yn(2),It<256)e[d++]=It;else if(It==256){Mt=u,f=null;break}else{var J=It-254;if(It>264){var N=It-257,pt=ad[N];J=En(i,u,(1<<pt)-1)+ud[N],u+=pt}var yt=m[_c(i,u)&et],Ct=yt>>4;yt||yn(3),u+=yt&15;var W=Tg[Ct];if(Ct>3){var pt=ld[Ct];W+=_c(i,u)&(1<<pt)-1,u+=pt}if(u>g){l&&yn(0);break}a&&c(d+131072);var gt=d+J;if(d<W){var Ut=r-W,xe=Math.min(W,gt);for(Ut+d<0&&yn(3);d<xe;++d)e[d]=n[Ut+d]}for(;d<gt;++d)e[d]=e[d-W]}}t.l=f,t.p=Mt,t.b=d,t.f=h,f&&(h=1,t.m=x,t.d=m,t.n=p)}while(!h);return d!=e.length&&o?pd(e,0,d):e.subarray(0,d)};var Ig=new Mn(0);var Lg=function(i,t){return((i[0]&15)!=8||i[0]>>4>7||(i[0]<<8|i[1])%31)&&yn(6,"invalid zlib data"),(i[1]>>5&1)==+!t&&yn(6,"invalid zlib data: "+(i[1]&32?"need":"unexpected")+" dictionary"),(i[1]>>3&4)+2};function md(i,t){return Pg(i.subarray(Lg(i,t&&t.dictionary),-4),{i:2},t&&t.out,t&&t.dictionary)}var vc=typeof TextDecoder<"u"&&new TextDecoder,Dg=0;try{vc.decode(Ig,{stream:!0}),Dg=1}catch{}var Ng=function(i){for(var t="",e=0;;){var n=i[e++],s=(n>127)+(n>223)+(n>239);if(e+s>i.length)return{s:t,r:pd(i,e-1)};s?s==3?(n=((n&15)<<18|(i[e++]&63)<<12|(i[e++]&63)<<6|i[e++]&63)-65536,t+=String.fromCharCode(55296|n>>10,56320|n&1023)):s&1?t+=String.fromCharCode((n&31)<<6|i[e++]&63):t+=String.fromCharCode((n&15)<<12|(i[e++]&63)<<6|i[e++]&63):t+=String.fromCharCode(n)}};function gd(i,t){if(t){for(var e="",n=0;n<i.length;n+=16384)e+=String.fromCharCode.apply(null,i.subarray(n,n+16384));return e}else{if(vc)return vc.decode(i);var s=Ng(i),r=s.s,e=s.r;return e.length&&yn(8),r}}var yc=1n<<900n,nt=class i{constructor(t,e=1n){let n=e<0n?-1n:1n,s=Fg(t<0n?-t:t,n*e);this.numerator=n*t/s,this.denominator=n*e/s}static of(t){return t instanceof i?t:typeof t=="bigint"?new i(t):typeof t=="number"?Og(t):Ug(String(t))}static parse(t){try{return t==null?null:i.of(t)}catch{return null}}static near(t,e=9){return new i(BigInt(Math.round(t*10**e)),10n**BigInt(e))}plus(t){let{numerator:e,denominator:n}=i.of(t);return new i(this.numerator*n+e*this.denominator,this.denominator*n)}minus(t){let{numerator:e,denominator:n}=i.of(t);return this.plus(new i(-e,n))}times(t){let{numerator:e,denominator:n}=i.of(t);return new i(this.numerator*e,this.denominator*n)}over(t){let{numerator:e,denominator:n}=i.of(t);return new i(this.numerator*n,this.denominator*e)}equals(t){let{numerator:e,denominator:n}=i.of(t);return this.numerator===e&&this.denominator===n}get floor(){let t=this.numerator/this.denominator;return t*this.denominator>this.numerator?t-1n:t}get part(){return Mc(this.numerator-this.floor*this.denominator,this.denominator)}valueOf(){return Mc(this.numerator,this.denominator)}toString(){return this.denominator===1n?`${this.numerator}`:`${this.numerator}/${this.denominator}`}};function bc(i,t){let e=i.denominator*t.denominator,n=i.numerator*t.numerator%e;return 2n*n>=e?n-=e:2n*n<-e&&(n+=e),Mc(n,e)}function Mc(i,t){if(t<yc&&i<yc&&i>-yc)return Number(i)/Number(t);let e=a=>(a<0n?-a:a).toString(16).length*4,n=a=>BigInt(Math.max(0,e(a)-200)),[s,r]=[n(i),n(t)],o=Number(s-r);return Number(i>>s)/Number(t>>r)*2**o}function Og(i){if(!Number.isFinite(i))throw new RangeError(`${i} is not a number of turns`);let t=0;for(;!Number.isInteger(i);)i*=2,t+=1;return new nt(BigInt(i),1n<<BigInt(t))}function Ug(i){let t=/^\s*([+-]?)(\d*)(?:\.(\d*))?(?:e([+-]?\d{1,4}))?(?:\s*\/\s*(\d+))?\s*$/i.exec(i.replace("−","-"));if(!t||!(t[2]||t[3]))throw new RangeError(`"${i}" is not a number`);let[,e,n,s="",r="0",o="1"]=t;if(BigInt(o)===0n)throw new RangeError(`"${i}" divides by zero`);let a=BigInt(r)-BigInt(s.length),l=BigInt(`${n}${s}`)*(e==="-"?-1n:1n),[c,h]=a<0n?[1n,10n**-a]:[10n**a,1n];return new nt(l*c,h*BigInt(o))}function Fg(i,t){for(;t;)[i,t]=[t,i%t];return i||1n}var co=class{constructor({period:t,breaks:e,coefficients:n}){this.period=t,this.breaks=_d(e);let s=this.breaks.length-1;this.coefficients=_d(n),this.terms=this.coefficients.length/s}at(t){let e=t-Math.floor(t/this.period)*this.period,n=this.cell(e),s=e-(this.breaks[n]+this.breaks[n+1])/2,r=n*this.terms,o=0,a=0;for(let l=this.terms-1;l>=0;l-=1)a=a*s+o,o=o*s+this.coefficients[r+l];return[o,a]}cell(t){let e=0,n=this.breaks.length-1;for(;n-e>1;){let s=e+n>>1;this.breaks[s]<=t?e=s:n=s}return e}};function xd(i,t,e,n){let s=h=>i.map((u,d)=>u.at(e[d]+Sc(n[d],h)).map(f=>t[d]*f)),r=1+Math.max(...e.map(Math.abs))+Math.max(...n.map(h=>Sc(h.map(Math.abs),h.map(()=>1)))),o=i.map((h,u)=>t[u]*h.at(e[u])[0]),a=o.map(()=>0),l=1,c=1/0;for(let h=0;h<120;h+=1){let u=o.map((p,g)=>p-l*a[g]),d=s(u),f=u.map((p,g)=>p-d[g][0]),m=Math.max(...f.map(Math.abs));if(m>=c){if(l/=2,l<1e-9)break;continue}if([o,c,l]=[u,m,1],m<=2e-15*r)break;let x=d.map(([,p],g)=>n[g].map((S,w)=>(g===w?1:0)-p*S));a=Bg(x,f)}return o}var Sc=(i,t)=>i.reduce((e,n,s)=>e+n*t[s],0);function Bg(i,t){let e=i.map((s,r)=>[...s,t[r]]);for(let s=0;s<e.length;s+=1){let r=s;for(let o=s+1;o<e.length;o+=1)Math.abs(e[o][s])>Math.abs(e[r][s])&&(r=o);[e[s],e[r]]=[e[r],e[s]];for(let o=s+1;o<e.length;o+=1){let a=e[o][s]/e[s][s];for(let l=s;l<=e.length;l+=1)e[o][l]-=a*e[s][l]}}let n=t.map(()=>0);for(let s=e.length-1;s>=0;s-=1)n[s]=(e[s][e.length]-Sc(e[s].slice(0,e.length),n))/e[s][s];return n}function _d(i){let t=Uint8Array.from(atob(i),e=>e.charCodeAt(0));return new Float64Array(t.buffer)}var ho=class{constructor(t){Object.assign(this,{period:t.period,duration:t.duration,step:t.step}),this.links=t.links.map(({rate:e,samples:n,angles:s})=>({rate:e,samples:vd(n),angles:yd(s)})),this.contacts=t.contacts.map(e=>({...e,changes:vd(e.changes),impact_times:kg(e.impact_times),impact_speeds:yd(e.impact_speeds)})),this.hardest=Math.max(0,...this.contacts.map(({hardest:e})=>e)),this.blows=Float64Array.from(this.contacts.flatMap(({impact_times:e})=>[...e])).sort(),this.glow=.35,this.slip=1e-12*Math.max(this.duration,this.period)}turned(t,e){let{rate:n,samples:s,angles:r}=this.links[t],o=Math.min(Math.max(e,0),this.duration),a=o/this.step,l=Math.min(Gi(s,a),s.length-2),c=(a-s[l])/(s[l+1]-s[l]);return n*o+r[l]+c*(r[l+1]-r[l])}state(t,e){let{changes:n,states:s}=this.contacts[t];return s?s[Math.max(0,Gi(n,e/this.step+1e-6))]:""}*stretches(t,e,n){let{changes:s,states:r}=this.contacts[t];for(let o=Math.max(0,Gi(s,e/this.step));o<s.length;o+=1){let a=s[o]*this.step;if(a>n)return;let l=o+1<s.length?s[o+1]*this.step:this.duration;yield[r[o],Math.max(a,e),Math.min(l,n)]}}*blowsOf(t,e,n){let{impact_times:s,impact_speeds:r}=this.contacts[t];for(let o=Gi(s,e)+1;o<s.length&&s[o]<=n;o+=1)yield[s[o],this.strength(r[o])]}strength(t){return .4+.6*Math.sqrt(t/this.hardest)}flash(t,e){let{impact_times:n,impact_speeds:s}=this.contacts[t],r=0;for(let o=Gi(n,e+this.slip);o>=0&&e-n[o]<3*this.glow&&(r=Math.max(r,this.strength(s[o])*Math.exp((n[o]-e)/this.glow)),!(r>.99));o-=1);return r}set pace(t){this.glow=.35*t}blowFrom(t,e){let n=e>0?Gi(this.blows,t+this.slip)+1:Gi(this.blows,t-this.slip);return this.blows[n]??(e>0?this.duration:0)}};function Gi(i,t){let[e,n]=[0,i.length];for(;e<n;){let s=e+n>>1;i[s]<=t?e=s+1:n=s}return e-1}var wc=i=>Uint8Array.from(atob(i),t=>t.charCodeAt(0)).buffer,vd=i=>new Uint32Array(wc(i)),yd=i=>new Float32Array(wc(i)),kg=i=>new Float64Array(wc(i));var gi=2*Math.PI,_i=class{constructor(t){this.scene=t,this.lead=t.driving_link,this.moves=t.movement.kind!=="still"&&t.driving_link!==null,this.step=nt.of(t.step||"1"),this.period=t.movement.period===null?null:nt.of(t.movement.period),this.speeds=t.bodies.map(n=>n.speed===null?null:nt.of(n.speed));let e=t.bodies.map(({id:n})=>n);this.ahead=new uo(t.movement,e),this.back=t.back?new uo(t.back,e):this.ahead,this.turns=nt.of(0),t.run&&(this.run=new ho(t.run),this.simulated=!t.touching,this.initial=this.ahead.at(this.turns))}time(t=this.turns){return Number(nt.of(t))*this.run.period}made(t=this.turns){return this.run?nt.near(this.run.turned(this.scene.driving_link,this.time(t))/gi,14):nt.of(t)}declared(t,e=this.turns){if(this.simulated)return this.scene.bodies[t].start+this.initial[t]+this.run.turned(t,this.time(e));let n=this.speeds[t],s=this.made(e),r=this.scene.bodies[t].travels?(a,l)=>Number(a)*Number(l):bc,o=n?gi*r(n,s):0;return this.scene.bodies[t].start+o+this.errors(s)[t]}angle(t,e=this.turns){return this.scene.bodies[t].sense*this.declared(t,e)}joint(t,e=this.turns){let{parent:n,base:s}=this.scene.bodies[t],r=s??n;return this.angle(t,e)-(r===null?0:this.angle(r,e))}errors(t=this.turns){let e=nt.of(t);return(!this.latest||!this.latestTurns.equals(e))&&(this.latest=(e.numerator*this.step.numerator<0n?this.back:this.ahead).at(e),this.latestTurns=e),this.latest}pointer(t,e=this.turns){let{body:n,base:s,dial:r}=this.scene.pointers[t],{mean:o,error:a}=this.simulated?this.played(t,e):this.followed(t,this.made(e)),l=this.scene.bodies,c=o.part*gi+l[n].start-l[s].start+a,h=Math.floor(c/gi),u=Math.min(Math.max(c-h*gi,0),gi),d=o.floor+BigInt(h),f=BigInt((r===null?1:this.scene.dials[r].scale.turns)||1),m=Number((d%f+f)%f)+u/gi;return{angle:u,text:zg(u),error:a,mean:o,whole:d,along:m}}followed(t,e){let{body:n,base:s,speed:r}=this.scene.pointers[t],o=nt.of(e),a=this.errors(o);return{mean:r===null?nt.of(0):nt.of(r).times(o),error:a[n]-a[s]}}played(t,e){let{body:n,base:s}=this.scene.pointers[t],r=this.time(e),o=this.run.turned(n,r)-this.run.turned(s,r)+this.initial[n]-this.initial[s];return{mean:nt.of(0),error:o}}aheadBy(t,e=this.turns){let{speed:n}=this.scene.pointers[t],{mean:s,error:r}=this.followed(t,this.made(e));return(Number(nt.of(n??"0"))*this.run.links[this.scene.driving_link].rate<0?-1:1)*(this.played(t,e).error-gi*Number(s)-r)}},zg=i=>`${(i*180/Math.PI).toFixed(3)}°`,uo=class{constructor({transmissions:t,sources:e,steps:n,offsets:s},r){this.count=r.length,this.transmissions=t.map(o=>new co(o)),this.sources=e.map(o=>({...o,cycles:nt.of(o.cycles)})),this.steps=n,this.offsets=Object.entries(s).map(([o,a])=>[r.indexOf(o),a])}at(t){let e=new Float64Array(this.sources.length);for(let s of this.steps)this.take(s,t,e);let n=new Float64Array(this.count);this.sources.forEach(({bodies:s,weights:r},o)=>s.forEach((a,l)=>n[a]+=r[l]*e[o]));for(let[s,r]of this.offsets)n[s]+=r;return n}take({sources:t,known:e,from_known:n,own:s},r,o){let a=t.map(u=>this.sources[u]),l=a.map(u=>this.transmissions[u.transmission]),c=a.map(({start:u,cycles:d},f)=>e.reduce((m,x,p)=>m+n[f][p]*o[x],u+bc(d,r)*l[f].period)),h=s.length?xd(l,a.map(({sense:u})=>u),c,s):a.map(({sense:u},d)=>u*l[d].at(c[d])[0]);t.forEach((u,d)=>o[u]=h[d])}};var Ii={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},Li={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},Jd=0,eh=1,Kd=2;var Pr=1,jd=2,Rs=3,Di=0,Be=1,Xn=2,Yi=0,Ps=1,nh=2,ih=3,sh=4,Qd=5;var Zi=100,tf=101,ef=102,nf=103,sf=104,rf=200,of=201,af=202,lf=203,rh=204,oh=205,cf=206,hf=207,uf=208,df=209,ff=210,pf=211,mf=212,gf=213,_f=214,ko=0,zo=1,Go=2,vs=3,Vo=4,Ho=5,Wo=6,Xo=7,ah=0,xf=1,vf=2,qn=0,lh=1,ch=2,hh=3,uh=4,dh=5,fh=6,ph=7;var mh=300,Ji=301,Is=302,ma=303,ga=304,qo=1e3,zn=1001,$o=1002,ve=1003,yf=1004;var Ir=1005;var Ze=1006,_a=1007;var ci=1008;var Je=1009,gh=1010,_h=1011,Ls=1012,xa=1013,Ln=1014,pn=1015,Dn=1016,va=1017,ya=1018,Ki=1020,xh=35902,vh=35899,yh=1021,Mh=1022,Ke=1023,ai=1026,hi=1027,bh=1028,Ma=1029,Ni=1030,ba=1031;var Sa=1033,Lr=33776,Dr=33777,Nr=33778,Or=33779,wa=35840,Ta=35841,Ea=35842,Aa=35843,Ca=36196,Ra=37492,Pa=37496,Ia=37488,La=37489,Ur=37490,Da=37491,Na=37808,Oa=37809,Ua=37810,Fa=37811,Ba=37812,ka=37813,za=37814,Ga=37815,Va=37816,Ha=37817,Wa=37818,Xa=37819,qa=37820,$a=37821,Ya=36492,Za=36494,Ja=36495,Ka=36283,ja=36284,Fr=36285,Qa=36286;var lr=2300,Yo=2301,Fo=2302,Wc=2303,Xc=2400,qc=2401,$c=2402;var Mf=3200;var Sh=0,bf=1,ui="",ln="srgb",cr="srgb-linear",hr="linear",oe="srgb";var Bo=7680;var Sf=519,wf=512,Tf=513,Ef=514,wh=515,Af=516,Cf=517,Th=518,Eh=519,Rf=35044;var di="300 es",Sn=2e3,ur=2001;function Gg(i){for(let t=i.length-1;t>=0;--t)if(i[t]>=65535)return!0;return!1}function Vg(i){return ArrayBuffer.isView(i)&&!(i instanceof DataView)}function dr(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function Pf(){let i=dr("canvas");return i.style.display="block",i}var Md={},ys=null;function Ah(...i){let t="THREE."+i.shift();ys?ys("log",t,...i):console.log(t,...i)}function If(i){let t=i[0];if(typeof t=="string"&&t.startsWith("TSL:")){let e=i[1];e&&e.isStackTrace?i[0]+=" "+e.getLocation():i[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return i}function Nt(...i){i=If(i);let t="THREE."+i.shift();if(ys)ys("warn",t,...i);else{let e=i[0];e&&e.isStackTrace?console.warn(e.getError(t)):console.warn(t,...i)}}function Ot(...i){i=If(i);let t="THREE."+i.shift();if(ys)ys("error",t,...i);else{let e=i[0];e&&e.isStackTrace?console.error(e.getError(t)):console.error(t,...i)}}function rr(...i){let t=i.join(" ");t in Md||(Md[t]=!0,Nt(...i))}function Lf(i,t,e){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(t,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:n()}}setTimeout(r,e)})}var Df={[ko]:ko,[Go]:Wo,[Vo]:Vo,[vs]:Ho,[zo]:zo,[Wo]:Go,[Xo]:Xo,[Ho]:vs},Pn=class{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});let n=this._listeners;n[t]===void 0&&(n[t]=[]),n[t].indexOf(e)===-1&&n[t].push(e)}hasEventListener(t,e){let n=this._listeners;return n===void 0?!1:n[t]!==void 0&&n[t].indexOf(e)!==-1}removeEventListener(t,e){let n=this._listeners;if(n===void 0)return;let s=n[t];if(s!==void 0){let r=s.indexOf(e);r!==-1&&s.splice(r,1)}}dispatchEvent(t){let e=this._listeners;if(e===void 0)return;let n=e[t.type];if(n!==void 0){t.target=this;let s=n.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,t);t.target=null}}},Ve=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],bd=1234567,or=Math.PI/180,Ms=180/Math.PI;function Ds(){let i=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(Ve[i&255]+Ve[i>>8&255]+Ve[i>>16&255]+Ve[i>>24&255]+"-"+Ve[t&255]+Ve[t>>8&255]+"-"+Ve[t>>16&15|64]+Ve[t>>24&255]+"-"+Ve[e&63|128]+Ve[e>>8&255]+"-"+Ve[e>>16&255]+Ve[e>>24&255]+Ve[n&255]+Ve[n>>8&255]+Ve[n>>16&255]+Ve[n>>24&255]).toLowerCase()}function qt(i,t,e){return Math.max(t,Math.min(e,i))}function Ch(i,t){return(i%t+t)%t}function Hg(i,t,e,n,s){return n+(i-t)*(s-n)/(e-t)}function Wg(i,t,e){return i!==t?(e-i)/(t-i):0}function ar(i,t,e){return(1-e)*i+e*t}function Xg(i,t,e,n){return ar(i,t,1-Math.exp(-e*n))}function qg(i,t=1){return t-Math.abs(Ch(i,t*2)-t)}function $g(i,t,e){return i<=t?0:i>=e?1:(i=(i-t)/(e-t),i*i*(3-2*i))}function Yg(i,t,e){return i<=t?0:i>=e?1:(i=(i-t)/(e-t),i*i*i*(i*(i*6-15)+10))}function Zg(i,t){return i+Math.floor(Math.random()*(t-i+1))}function Jg(i,t){return i+Math.random()*(t-i)}function Kg(i){return i*(.5-Math.random())}function jg(i){i!==void 0&&(bd=i);let t=bd+=1831565813;return t=Math.imul(t^t>>>15,t|1),t^=t+Math.imul(t^t>>>7,t|61),((t^t>>>14)>>>0)/4294967296}function Qg(i){return i*or}function t0(i){return i*Ms}function e0(i){return i>0&&Number.isInteger(i)&&2**Math.round(Math.log2(i))===i}function n0(i){return Math.pow(2,Math.ceil(Math.log(i)/Math.LN2))}function Rh(i){return Math.pow(2,Math.floor(Math.log(i)/Math.LN2))}function i0(i,t,e,n,s){let r=Math.cos,o=Math.sin,a=r(e/2),l=o(e/2),c=r((t+n)/2),h=o((t+n)/2),u=r((t-n)/2),d=o((t-n)/2),f=r((n-t)/2),m=o((n-t)/2);switch(s){case"XYX":i.set(a*h,l*u,l*d,a*c);break;case"YZY":i.set(l*d,a*h,l*u,a*c);break;case"ZXZ":i.set(l*u,l*d,a*h,a*c);break;case"XZX":i.set(a*h,l*m,l*f,a*c);break;case"YXY":i.set(l*f,a*h,l*m,a*c);break;case"ZYZ":i.set(l*m,l*f,a*h,a*c);break;default:Nt("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function Ph(i){switch(i.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function Nf(i,t){if(t.constructor===Float32Array)return i;let e=Ph(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(i/e,-1)}function Of(i,t){if(t.constructor===Float32Array)return i;let e=Ph(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(i*e)}var Ih={DEG2RAD:or,RAD2DEG:Ms,generateUUID:Ds,clamp:qt,euclideanModulo:Ch,mapLinear:Hg,inverseLerp:Wg,lerp:ar,damp:Xg,pingpong:qg,smoothstep:$g,smootherstep:Yg,randInt:Zg,randFloat:Jg,randFloatSpread:Kg,seededRandom:jg,degToRad:Qg,radToDeg:t0,isPowerOfTwo:e0,ceilPowerOfTwo:n0,floorPowerOfTwo:Rh,setQuaternionFromProperEuler:i0,normalize:Of,denormalize:Nf},Dt=class{static{this.prototype.isVector2=!0}constructor(t=0,e=0){this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("THREE.Vector2: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){let e=this.x,n=this.y,s=t.elements;return this.x=s[0]*e+s[3]*n+s[6],this.y=s[1]*e+s[4]*n+s[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=qt(this.x,t.x,e.x),this.y=qt(this.y,t.y,e.y),this}clampScalar(t,e){return this.x=qt(this.x,t,e),this.y=qt(this.y,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(qt(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let n=this.dot(t)/e;return Math.acos(qt(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,n=this.y-t.y;return e*e+n*n}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){let n=Math.cos(e),s=Math.sin(e),r=this.x-t.x,o=this.y-t.y;return this.x=r*n-o*s+t.x,this.y=r*s+o*n+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},cn=class{constructor(t=0,e=0,n=0,s=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=n,this._w=s}static slerpFlat(t,e,n,s,r,o,a){let l=n[s+0],c=n[s+1],h=n[s+2],u=n[s+3],d=r[o+0],f=r[o+1],m=r[o+2],x=r[o+3];if(u!==x||l!==d||c!==f||h!==m){let p=l*d+c*f+h*m+u*x;p<0&&(d=-d,f=-f,m=-m,x=-x,p=-p);let g=1-a;if(p<.9995){let S=Math.acos(p),w=Math.sin(S);g=Math.sin(g*S)/w,a=Math.sin(a*S)/w,l=l*g+d*a,c=c*g+f*a,h=h*g+m*a,u=u*g+x*a}else{l=l*g+d*a,c=c*g+f*a,h=h*g+m*a,u=u*g+x*a;let S=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=S,c*=S,h*=S,u*=S}}t[e]=l,t[e+1]=c,t[e+2]=h,t[e+3]=u}static multiplyQuaternionsFlat(t,e,n,s,r,o){let a=n[s],l=n[s+1],c=n[s+2],h=n[s+3],u=r[o],d=r[o+1],f=r[o+2],m=r[o+3];return t[e]=a*m+h*u+l*f-c*d,t[e+1]=l*m+h*d+c*u-a*f,t[e+2]=c*m+h*f+a*d-l*u,t[e+3]=h*m-a*u-l*d-c*f,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,n,s){return this._x=t,this._y=e,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){let n=t._x,s=t._y,r=t._z,o=t._order,a=Math.cos,l=Math.sin,c=a(n/2),h=a(s/2),u=a(r/2),d=l(n/2),f=l(s/2),m=l(r/2);switch(o){case"XYZ":this._x=d*h*u+c*f*m,this._y=c*f*u-d*h*m,this._z=c*h*m+d*f*u,this._w=c*h*u-d*f*m;break;case"YXZ":this._x=d*h*u+c*f*m,this._y=c*f*u-d*h*m,this._z=c*h*m-d*f*u,this._w=c*h*u+d*f*m;break;case"ZXY":this._x=d*h*u-c*f*m,this._y=c*f*u+d*h*m,this._z=c*h*m+d*f*u,this._w=c*h*u-d*f*m;break;case"ZYX":this._x=d*h*u-c*f*m,this._y=c*f*u+d*h*m,this._z=c*h*m-d*f*u,this._w=c*h*u+d*f*m;break;case"YZX":this._x=d*h*u+c*f*m,this._y=c*f*u+d*h*m,this._z=c*h*m-d*f*u,this._w=c*h*u-d*f*m;break;case"XZY":this._x=d*h*u-c*f*m,this._y=c*f*u-d*h*m,this._z=c*h*m+d*f*u,this._w=c*h*u+d*f*m;break;default:Nt("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){let n=e/2,s=Math.sin(n);return this._x=t.x*s,this._y=t.y*s,this._z=t.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(t){let e=t.elements,n=e[0],s=e[4],r=e[8],o=e[1],a=e[5],l=e[9],c=e[2],h=e[6],u=e[10],d=n+a+u;if(d>0){let f=.5/Math.sqrt(d+1);this._w=.25/f,this._x=(h-l)*f,this._y=(r-c)*f,this._z=(o-s)*f}else if(n>a&&n>u){let f=2*Math.sqrt(1+n-a-u);this._w=(h-l)/f,this._x=.25*f,this._y=(s+o)/f,this._z=(r+c)/f}else if(a>u){let f=2*Math.sqrt(1+a-n-u);this._w=(r-c)/f,this._x=(s+o)/f,this._y=.25*f,this._z=(l+h)/f}else{let f=2*Math.sqrt(1+u-n-a);this._w=(o-s)/f,this._x=(r+c)/f,this._y=(l+h)/f,this._z=.25*f}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let n=t.dot(e)+1;return n<1e-8?(n=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=n):(this._x=0,this._y=-t.z,this._z=t.y,this._w=n)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=n),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(qt(this.dot(t),-1,1)))}rotateTowards(t,e){let n=this.angleTo(t);if(n===0)return this;let s=Math.min(1,e/n);return this.slerp(t,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){let n=t._x,s=t._y,r=t._z,o=t._w,a=e._x,l=e._y,c=e._z,h=e._w;return this._x=n*h+o*a+s*c-r*l,this._y=s*h+o*l+r*a-n*c,this._z=r*h+o*c+n*l-s*a,this._w=o*h-n*a-s*l-r*c,this._onChangeCallback(),this}slerp(t,e){let n=t._x,s=t._y,r=t._z,o=t._w,a=this.dot(t);a<0&&(n=-n,s=-s,r=-r,o=-o,a=-a);let l=1-e;if(a<.9995){let c=Math.acos(a),h=Math.sin(c);l=Math.sin(l*c)/h,e=Math.sin(e*c)/h,this._x=this._x*l+n*e,this._y=this._y*l+s*e,this._z=this._z*l+r*e,this._w=this._w*l+o*e,this._onChangeCallback()}else this._x=this._x*l+n*e,this._y=this._y*l+s*e,this._z=this._z*l+r*e,this._w=this._w*l+o*e,this.normalize();return this}slerpQuaternions(t,e,n){return this.copy(t).slerp(e,n)}random(){let t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(t),s*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},O=class{static{this.prototype.isVector3=!0}constructor(t=0,e=0,n=0){this.x=t,this.y=e,this.z=n}set(t,e,n){return n===void 0&&(n=this.z),this.x=t,this.y=e,this.z=n,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("THREE.Vector3: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(Sd.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(Sd.setFromAxisAngle(t,e))}applyMatrix3(t){let e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[3]*n+r[6]*s,this.y=r[1]*e+r[4]*n+r[7]*s,this.z=r[2]*e+r[5]*n+r[8]*s,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){let e=this.x,n=this.y,s=this.z,r=t.elements,o=1/(r[3]*e+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*e+r[4]*n+r[8]*s+r[12])*o,this.y=(r[1]*e+r[5]*n+r[9]*s+r[13])*o,this.z=(r[2]*e+r[6]*n+r[10]*s+r[14])*o,this}applyQuaternion(t){let e=this.x,n=this.y,s=this.z,r=t.x,o=t.y,a=t.z,l=t.w,c=2*(o*s-a*n),h=2*(a*e-r*s),u=2*(r*n-o*e);return this.x=e+l*c+o*u-a*h,this.y=n+l*h+a*c-r*u,this.z=s+l*u+r*h-o*c,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){let e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[4]*n+r[8]*s,this.y=r[1]*e+r[5]*n+r[9]*s,this.z=r[2]*e+r[6]*n+r[10]*s,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=qt(this.x,t.x,e.x),this.y=qt(this.y,t.y,e.y),this.z=qt(this.z,t.z,e.z),this}clampScalar(t,e){return this.x=qt(this.x,t,e),this.y=qt(this.y,t,e),this.z=qt(this.z,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(qt(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){let n=t.x,s=t.y,r=t.z,o=e.x,a=e.y,l=e.z;return this.x=s*l-r*a,this.y=r*o-n*l,this.z=n*a-s*o,this}projectOnVector(t){let e=t.lengthSq();if(e===0)return this.set(0,0,0);let n=t.dot(this)/e;return this.copy(t).multiplyScalar(n)}projectOnPlane(t){return Tc.copy(this).projectOnVector(t),this.sub(Tc)}reflect(t){return this.sub(Tc.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let n=this.dot(t)/e;return Math.acos(qt(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,n=this.y-t.y,s=this.z-t.z;return e*e+n*n+s*s}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,n){let s=Math.sin(e)*t;return this.x=s*Math.sin(n),this.y=Math.cos(e)*t,this.z=s*Math.cos(n),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,n){return this.x=t*Math.sin(e),this.y=n,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){let e=this.setFromMatrixColumn(t,0).length(),n=this.setFromMatrixColumn(t,1).length(),s=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=n,this.z=s,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let t=Math.random()*Math.PI*2,e=Math.random()*2-1,n=Math.sqrt(1-e*e);return this.x=n*Math.cos(t),this.y=e,this.z=n*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},Tc=new O,Sd=new cn,Ft=class{static{this.prototype.isMatrix3=!0}constructor(t,e,n,s,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,o,a,l,c)}set(t,e,n,s,r,o,a,l,c){let h=this.elements;return h[0]=t,h[1]=s,h[2]=a,h[3]=e,h[4]=r,h[5]=l,h[6]=n,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){let e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],this}extractBasis(t,e,n){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(t){let e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let n=t.elements,s=e.elements,r=this.elements,o=n[0],a=n[3],l=n[6],c=n[1],h=n[4],u=n[7],d=n[2],f=n[5],m=n[8],x=s[0],p=s[3],g=s[6],S=s[1],w=s[4],b=s[7],C=s[2],A=s[5],_=s[8];return r[0]=o*x+a*S+l*C,r[3]=o*p+a*w+l*A,r[6]=o*g+a*b+l*_,r[1]=c*x+h*S+u*C,r[4]=c*p+h*w+u*A,r[7]=c*g+h*b+u*_,r[2]=d*x+f*S+m*C,r[5]=d*p+f*w+m*A,r[8]=d*g+f*b+m*_,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8];return e*o*h-e*a*c-n*r*h+n*a*l+s*r*c-s*o*l}invert(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],u=h*o-a*c,d=a*l-h*r,f=c*r-o*l,m=e*u+n*d+s*f;if(m===0)return this.set(0,0,0,0,0,0,0,0,0);let x=1/m;return t[0]=u*x,t[1]=(s*c-h*n)*x,t[2]=(a*n-s*o)*x,t[3]=d*x,t[4]=(h*e-s*l)*x,t[5]=(s*r-a*e)*x,t[6]=f*x,t[7]=(n*l-c*e)*x,t[8]=(o*e-n*r)*x,this}transpose(){let t,e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){let e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,n,s,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*o+c*a)+o+t,-s*c,s*l,-s*(-c*o+l*a)+a+e,0,0,1),this}scale(t,e){return rr("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(Ec.makeScale(t,e)),this}rotate(t){return rr("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(Ec.makeRotation(-t)),this}translate(t,e){return rr("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(Ec.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,n,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){let e=this.elements,n=t.elements;for(let s=0;s<9;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<9;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){let n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t}clone(){return new this.constructor().fromArray(this.elements)}},Ec=new Ft,wd=new Ft().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Td=new Ft().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function s0(){let i={enabled:!0,workingColorSpace:cr,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===oe&&(s.r=oi(s.r),s.g=oi(s.g),s.b=oi(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===oe&&(s.r=xs(s.r),s.g=xs(s.g),s.b=xs(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===ui?hr:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},t=[.64,.33,.3,.6,.15,.06],e=[.2126,.7152,.0722],n=[.3127,.329];return i.define({[cr]:{primaries:t,whitePoint:n,transfer:hr,toXYZ:wd,fromXYZ:Td,luminanceCoefficients:e,workingColorSpaceConfig:{unpackColorSpace:ln},outputColorSpaceConfig:{drawingBufferColorSpace:ln}},[ln]:{primaries:t,whitePoint:n,transfer:oe,toXYZ:wd,fromXYZ:Td,luminanceCoefficients:e,outputColorSpaceConfig:{drawingBufferColorSpace:ln}}}),i}var Kt=s0();function oi(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function xs(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}var rs,Zo=class{static getDataURL(t,e="image/png"){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let n;if(t instanceof HTMLCanvasElement)n=t;else{rs===void 0&&(rs=dr("canvas")),rs.width=t.width,rs.height=t.height;let s=rs.getContext("2d");t instanceof ImageData?s.putImageData(t,0,0):s.drawImage(t,0,0,t.width,t.height),n=rs}return n.toDataURL(e)}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){let e=dr("canvas");e.width=t.width,e.height=t.height;let n=e.getContext("2d");n.drawImage(t,0,0,t.width,t.height);let s=n.getImageData(0,0,t.width,t.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=oi(r[o]/255)*255;return n.putImageData(s,0,0),e}else if(t.data){let e=t.data.slice(0);for(let n=0;n<e.length;n++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[n]=Math.floor(oi(e[n]/255)*255):e[n]=oi(e[n]);return{data:e,width:t.width,height:t.height}}else return Nt("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}},r0=0,bs=class{constructor(t=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:r0++}),this.uuid=Ds(),this.data=t,this.dataReady=!0,this.version=0}getSize(t){let e=this.data;return typeof HTMLVideoElement<"u"&&e instanceof HTMLVideoElement?t.set(e.videoWidth,e.videoHeight,0):typeof VideoFrame<"u"&&e instanceof VideoFrame?t.set(e.displayWidth,e.displayHeight,0):e!==null?t.set(e.width||0,e.height||0,e.depth||0):t.set(0,0,0),t}set needsUpdate(t){t===!0&&this.version++}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];let n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(Ac(s[o].image)):r.push(Ac(s[o]))}else r=Ac(s);n.url=r}return e||(t.images[this.uuid]=n),n}};function Ac(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?Zo.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(Nt("Texture: Unable to serialize Texture."),{})}var o0=0,Cc=new O,Qe=class i extends Pn{constructor(t=i.DEFAULT_IMAGE,e=i.DEFAULT_MAPPING,n=zn,s=zn,r=Ze,o=ci,a=Ke,l=Je,c=i.DEFAULT_ANISOTROPY,h=ui){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:o0++}),this.uuid=Ds(),this.name="",this.source=new bs(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new Dt(0,0),this.repeat=new Dt(1,1),this.center=new Dt(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new Ft,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(t&&t.depth&&t.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(Cc).x}get height(){return this.source.getSize(Cc).y}get depth(){return this.source.getSize(Cc).z}get image(){return this.source.data}set image(t){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.normalized=t.normalized,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.mipmapsAutoUpdate=t.mipmapsAutoUpdate,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.renderTarget=t.renderTarget,this.isRenderTargetTexture=t.isRenderTargetTexture,this.isPMREMTexture=t.isPMREMTexture,this.isArrayTexture=t.isArrayTexture,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}setValues(t){for(let e in t){let n=t[e];if(n===void 0){Nt(`Texture.setValues(): parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){Nt(`Texture.setValues(): property '${e}' does not exist.`);continue}s&&n&&s.isVector2&&n.isVector2||s&&n&&s.isVector3&&n.isVector3||s&&n&&s.isMatrix3&&n.isMatrix3?s.copy(n):this[e]=n}}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];let n={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),e||(t.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==mh)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case qo:t.x=t.x-Math.floor(t.x);break;case zn:t.x=t.x<0?0:1;break;case $o:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case qo:t.y=t.y-Math.floor(t.y);break;case zn:t.y=t.y<0?0:1;break;case $o:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}};Qe.DEFAULT_IMAGE=null;Qe.DEFAULT_MAPPING=mh;Qe.DEFAULT_ANISOTROPY=1;var _e=class{static{this.prototype.isVector4=!0}constructor(t=0,e=0,n=0,s=1){this.x=t,this.y=e,this.z=n,this.w=s}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,n,s){return this.x=t,this.y=e,this.z=n,this.w=s,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("THREE.Vector4: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){let e=this.x,n=this.y,s=this.z,r=this.w,o=t.elements;return this.x=o[0]*e+o[4]*n+o[8]*s+o[12]*r,this.y=o[1]*e+o[5]*n+o[9]*s+o[13]*r,this.z=o[2]*e+o[6]*n+o[10]*s+o[14]*r,this.w=o[3]*e+o[7]*n+o[11]*s+o[15]*r,this}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this.w/=t.w,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);let e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,n,s,r,l=t.elements,c=l[0],h=l[4],u=l[8],d=l[1],f=l[5],m=l[9],x=l[2],p=l[6],g=l[10];if(Math.abs(h-d)<.01&&Math.abs(u-x)<.01&&Math.abs(m-p)<.01){if(Math.abs(h+d)<.1&&Math.abs(u+x)<.1&&Math.abs(m+p)<.1&&Math.abs(c+f+g-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;let w=(c+1)/2,b=(f+1)/2,C=(g+1)/2,A=(h+d)/4,_=(u+x)/4,T=(m+p)/4;return w>b&&w>C?w<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(w),s=A/n,r=_/n):b>C?b<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(b),n=A/s,r=T/s):C<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(C),n=_/r,s=T/r),this.set(n,s,r,e),this}let S=Math.sqrt((p-m)*(p-m)+(u-x)*(u-x)+(d-h)*(d-h));return Math.abs(S)<.001&&(S=1),this.x=(p-m)/S,this.y=(u-x)/S,this.z=(d-h)/S,this.w=Math.acos((c+f+g-1)/2),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=qt(this.x,t.x,e.x),this.y=qt(this.y,t.y,e.y),this.z=qt(this.z,t.z,e.z),this.w=qt(this.w,t.w,e.w),this}clampScalar(t,e){return this.x=qt(this.x,t,e),this.y=qt(this.y,t,e),this.z=qt(this.z,t,e),this.w=qt(this.w,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(qt(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this.w=t.w+(e.w-t.w)*n,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},Jo=class extends Pn{constructor(t=1,e=1,n={}){super(),n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Ze,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},n),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=n.depth,this.scissor=new _e(0,0,t,e),this.scissorTest=!1,this.viewport=new _e(0,0,t,e),this.textures=[];let s=n.count;for(let r=0;r<s;r++)this.textures[r]=new Qe({width:t,height:e,depth:n.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(n),this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveColorBuffer=n.resolveColorBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.storeMultisampledColorBuffer=n.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=n.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=n.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=n.depthTexture,this.samples=n.samples,this.multiview=n.multiview,this.useArrayDepthTexture=n.useArrayDepthTexture}_setTextureOptions(t={}){let e={minFilter:Ze,generateMipmaps:!1,flipY:!1,internalFormat:null};t.mapping!==void 0&&(e.mapping=t.mapping),t.wrapS!==void 0&&(e.wrapS=t.wrapS),t.wrapT!==void 0&&(e.wrapT=t.wrapT),t.wrapR!==void 0&&(e.wrapR=t.wrapR),t.magFilter!==void 0&&(e.magFilter=t.magFilter),t.minFilter!==void 0&&(e.minFilter=t.minFilter),t.format!==void 0&&(e.format=t.format),t.type!==void 0&&(e.type=t.type),t.anisotropy!==void 0&&(e.anisotropy=t.anisotropy),t.colorSpace!==void 0&&(e.colorSpace=t.colorSpace),t.flipY!==void 0&&(e.flipY=t.flipY),t.generateMipmaps!==void 0&&(e.generateMipmaps=t.generateMipmaps),t.mipmapsAutoUpdate!==void 0&&(e.mipmapsAutoUpdate=t.mipmapsAutoUpdate),t.internalFormat!==void 0&&(e.internalFormat=t.internalFormat);for(let n=0;n<this.textures.length;n++)this.textures[n].setValues(e)}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}set depthTexture(t){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),t!==null&&t.renderTarget===null&&(t.renderTarget=this),this._depthTexture=t}get depthTexture(){return this._depthTexture}setSize(t,e,n=1){if(this.width!==t||this.height!==e||this.depth!==n){this.width=t,this.height=e,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=t,this.textures[s].image.height=e,this.textures[s].image.depth=n,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let e=0,n=t.textures.length;e<n;e++){this.textures[e]=t.textures[e].clone(),this.textures[e].isRenderTargetTexture=!0,this.textures[e].renderTarget=this;let s=Object.assign({},t.textures[e].image);this.textures[e].source=new bs(s)}if(this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveColorBuffer=t.resolveColorBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,this.storeMultisampledColorBuffer=t.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=t.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=t.storeMultisampledStencilBuffer,t.depthTexture!==null)if(t.depthTexture.renderTarget===t){let e=t.depthTexture.clone();e.renderTarget=null,this.depthTexture=e}else this.depthTexture=t.depthTexture;else this.depthTexture=null;return this.samples=t.samples,this.multiview=t.multiview,this.useArrayDepthTexture=t.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},hn=class extends Jo{constructor(t=1,e=1,n={}){super(t,e,n),this.isWebGLRenderTarget=!0}},fr=class extends Qe{constructor(t=null,e=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=ve,this.minFilter=ve,this.wrapR=zn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}};var Ko=class extends Qe{constructor(t=null,e=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=ve,this.minFilter=ve,this.wrapR=zn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}};var Qt=class i{static{this.prototype.isMatrix4=!0}constructor(t,e,n,s,r,o,a,l,c,h,u,d,f,m,x,p){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,o,a,l,c,h,u,d,f,m,x,p)}set(t,e,n,s,r,o,a,l,c,h,u,d,f,m,x,p){let g=this.elements;return g[0]=t,g[4]=e,g[8]=n,g[12]=s,g[1]=r,g[5]=o,g[9]=a,g[13]=l,g[2]=c,g[6]=h,g[10]=u,g[14]=d,g[3]=f,g[7]=m,g[11]=x,g[15]=p,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new i().fromArray(this.elements)}copy(t){let e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],e[9]=n[9],e[10]=n[10],e[11]=n[11],e[12]=n[12],e[13]=n[13],e[14]=n[14],e[15]=n[15],this}copyPosition(t){let e=this.elements,n=t.elements;return e[12]=n[12],e[13]=n[13],e[14]=n[14],this}setFromMatrix3(t){let e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,n){return this.determinantAffine()===0?(t.set(1,0,0),e.set(0,1,0),n.set(0,0,1),this):(t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this)}makeBasis(t,e,n){return this.set(t.x,e.x,n.x,0,t.y,e.y,n.y,0,t.z,e.z,n.z,0,0,0,0,1),this}extractRotation(t){if(t.determinantAffine()===0)return this.identity();let e=this.elements,n=t.elements,s=1/os.setFromMatrixColumn(t,0).length(),r=1/os.setFromMatrixColumn(t,1).length(),o=1/os.setFromMatrixColumn(t,2).length();return e[0]=n[0]*s,e[1]=n[1]*s,e[2]=n[2]*s,e[3]=0,e[4]=n[4]*r,e[5]=n[5]*r,e[6]=n[6]*r,e[7]=0,e[8]=n[8]*o,e[9]=n[9]*o,e[10]=n[10]*o,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){let e=this.elements,n=t.x,s=t.y,r=t.z,o=Math.cos(n),a=Math.sin(n),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(t.order==="XYZ"){let d=o*h,f=o*u,m=a*h,x=a*u;e[0]=l*h,e[4]=-l*u,e[8]=c,e[1]=f+m*c,e[5]=d-x*c,e[9]=-a*l,e[2]=x-d*c,e[6]=m+f*c,e[10]=o*l}else if(t.order==="YXZ"){let d=l*h,f=l*u,m=c*h,x=c*u;e[0]=d+x*a,e[4]=m*a-f,e[8]=o*c,e[1]=o*u,e[5]=o*h,e[9]=-a,e[2]=f*a-m,e[6]=x+d*a,e[10]=o*l}else if(t.order==="ZXY"){let d=l*h,f=l*u,m=c*h,x=c*u;e[0]=d-x*a,e[4]=-o*u,e[8]=m+f*a,e[1]=f+m*a,e[5]=o*h,e[9]=x-d*a,e[2]=-o*c,e[6]=a,e[10]=o*l}else if(t.order==="ZYX"){let d=o*h,f=o*u,m=a*h,x=a*u;e[0]=l*h,e[4]=m*c-f,e[8]=d*c+x,e[1]=l*u,e[5]=x*c+d,e[9]=f*c-m,e[2]=-c,e[6]=a*l,e[10]=o*l}else if(t.order==="YZX"){let d=o*l,f=o*c,m=a*l,x=a*c;e[0]=l*h,e[4]=x-d*u,e[8]=m*u+f,e[1]=u,e[5]=o*h,e[9]=-a*h,e[2]=-c*h,e[6]=f*u+m,e[10]=d-x*u}else if(t.order==="XZY"){let d=o*l,f=o*c,m=a*l,x=a*c;e[0]=l*h,e[4]=-u,e[8]=c*h,e[1]=d*u+x,e[5]=o*h,e[9]=f*u-m,e[2]=m*u-f,e[6]=a*h,e[10]=x*u+d}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(a0,t,l0)}lookAt(t,e,n){let s=this.elements;return on.subVectors(t,e),on.lengthSq()===0&&(on.z=1),on.normalize(),xi.crossVectors(n,on),xi.lengthSq()===0&&(Math.abs(n.z)===1?on.x+=1e-4:on.z+=1e-4,on.normalize(),xi.crossVectors(n,on)),xi.normalize(),fo.crossVectors(on,xi),s[0]=xi.x,s[4]=fo.x,s[8]=on.x,s[1]=xi.y,s[5]=fo.y,s[9]=on.y,s[2]=xi.z,s[6]=fo.z,s[10]=on.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let n=t.elements,s=e.elements,r=this.elements,o=n[0],a=n[4],l=n[8],c=n[12],h=n[1],u=n[5],d=n[9],f=n[13],m=n[2],x=n[6],p=n[10],g=n[14],S=n[3],w=n[7],b=n[11],C=n[15],A=s[0],_=s[4],T=s[8],F=s[12],L=s[1],N=s[5],z=s[9],Y=s[13],I=s[2],X=s[6],$=s[10],V=s[14],it=s[3],W=s[7],tt=s[11],et=s[15];return r[0]=o*A+a*L+l*I+c*it,r[4]=o*_+a*N+l*X+c*W,r[8]=o*T+a*z+l*$+c*tt,r[12]=o*F+a*Y+l*V+c*et,r[1]=h*A+u*L+d*I+f*it,r[5]=h*_+u*N+d*X+f*W,r[9]=h*T+u*z+d*$+f*tt,r[13]=h*F+u*Y+d*V+f*et,r[2]=m*A+x*L+p*I+g*it,r[6]=m*_+x*N+p*X+g*W,r[10]=m*T+x*z+p*$+g*tt,r[14]=m*F+x*Y+p*V+g*et,r[3]=S*A+w*L+b*I+C*it,r[7]=S*_+w*N+b*X+C*W,r[11]=S*T+w*z+b*$+C*tt,r[15]=S*F+w*Y+b*V+C*et,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){let t=this.elements,e=t[0],n=t[4],s=t[8],r=t[12],o=t[1],a=t[5],l=t[9],c=t[13],h=t[2],u=t[6],d=t[10],f=t[14],m=t[3],x=t[7],p=t[11],g=t[15],S=l*f-c*d,w=a*f-c*u,b=a*d-l*u,C=o*f-c*h,A=o*d-l*h,_=o*u-a*h;return e*(x*S-p*w+g*b)-n*(m*S-p*C+g*A)+s*(m*w-x*C+g*_)-r*(m*b-x*A+p*_)}determinantAffine(){let t=this.elements,e=t[0],n=t[4],s=t[8],r=t[1],o=t[5],a=t[9],l=t[2],c=t[6],h=t[10];return e*(o*h-a*c)-n*(r*h-a*l)+s*(r*c-o*l)}transpose(){let t=this.elements,e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,n){let s=this.elements;return t.isVector3?(s[12]=t.x,s[13]=t.y,s[14]=t.z):(s[12]=t,s[13]=e,s[14]=n),this}invert(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],u=t[9],d=t[10],f=t[11],m=t[12],x=t[13],p=t[14],g=t[15],S=e*a-n*o,w=e*l-s*o,b=e*c-r*o,C=n*l-s*a,A=n*c-r*a,_=s*c-r*l,T=h*x-u*m,F=h*p-d*m,L=h*g-f*m,N=u*p-d*x,z=u*g-f*x,Y=d*g-f*p,I=S*Y-w*z+b*N+C*L-A*F+_*T;if(I===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let X=1/I;return t[0]=(a*Y-l*z+c*N)*X,t[1]=(s*z-n*Y-r*N)*X,t[2]=(x*_-p*A+g*C)*X,t[3]=(d*A-u*_-f*C)*X,t[4]=(l*L-o*Y-c*F)*X,t[5]=(e*Y-s*L+r*F)*X,t[6]=(p*b-m*_-g*w)*X,t[7]=(h*_-d*b+f*w)*X,t[8]=(o*z-a*L+c*T)*X,t[9]=(n*L-e*z-r*T)*X,t[10]=(m*A-x*b+g*S)*X,t[11]=(u*b-h*A-f*S)*X,t[12]=(a*F-o*N-l*T)*X,t[13]=(e*N-n*F+s*T)*X,t[14]=(x*w-m*C-p*S)*X,t[15]=(h*C-u*w+d*S)*X,this}scale(t){let e=this.elements,n=t.x,s=t.y,r=t.z;return e[0]*=n,e[4]*=s,e[8]*=r,e[1]*=n,e[5]*=s,e[9]*=r,e[2]*=n,e[6]*=s,e[10]*=r,e[3]*=n,e[7]*=s,e[11]*=r,this}getMaxScaleOnAxis(){let t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],n=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],s=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,n,s))}makeTranslation(t,e,n){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,n,0,0,0,1),this}makeRotationX(t){let e=Math.cos(t),n=Math.sin(t);return this.set(1,0,0,0,0,e,-n,0,0,n,e,0,0,0,0,1),this}makeRotationY(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,0,n,0,0,1,0,0,-n,0,e,0,0,0,0,1),this}makeRotationZ(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,0,n,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){let n=Math.cos(e),s=Math.sin(e),r=1-n,o=t.x,a=t.y,l=t.z,c=r*o,h=r*a;return this.set(c*o+n,c*a-s*l,c*l+s*a,0,c*a+s*l,h*a+n,h*l-s*o,0,c*l-s*a,h*l+s*o,r*l*l+n,0,0,0,0,1),this}makeScale(t,e,n){return this.set(t,0,0,0,0,e,0,0,0,0,n,0,0,0,0,1),this}makeShear(t,e,n,s,r,o){return this.set(1,n,r,0,t,1,o,0,e,s,1,0,0,0,0,1),this}compose(t,e,n){let s=this.elements,r=e._x,o=e._y,a=e._z,l=e._w,c=r+r,h=o+o,u=a+a,d=r*c,f=r*h,m=r*u,x=o*h,p=o*u,g=a*u,S=l*c,w=l*h,b=l*u,C=n.x,A=n.y,_=n.z;return s[0]=(1-(x+g))*C,s[1]=(f+b)*C,s[2]=(m-w)*C,s[3]=0,s[4]=(f-b)*A,s[5]=(1-(d+g))*A,s[6]=(p+S)*A,s[7]=0,s[8]=(m+w)*_,s[9]=(p-S)*_,s[10]=(1-(d+x))*_,s[11]=0,s[12]=t.x,s[13]=t.y,s[14]=t.z,s[15]=1,this}decompose(t,e,n){let s=this.elements;t.x=s[12],t.y=s[13],t.z=s[14];let r=this.determinantAffine();if(r===0)return n.set(1,1,1),e.identity(),this;let o=os.set(s[0],s[1],s[2]).length(),a=os.set(s[4],s[5],s[6]).length(),l=os.set(s[8],s[9],s[10]).length();r<0&&(o=-o),An.copy(this);let c=1/o,h=1/a,u=1/l;return An.elements[0]*=c,An.elements[1]*=c,An.elements[2]*=c,An.elements[4]*=h,An.elements[5]*=h,An.elements[6]*=h,An.elements[8]*=u,An.elements[9]*=u,An.elements[10]*=u,e.setFromRotationMatrix(An),n.x=o,n.y=a,n.z=l,this}makePerspective(t,e,n,s,r,o,a=Sn,l=!1){let c=this.elements,h=2*r/(e-t),u=2*r/(n-s),d=(e+t)/(e-t),f=(n+s)/(n-s),m,x;if(l)m=r/(o-r),x=o*r/(o-r);else if(a===Sn)m=-(o+r)/(o-r),x=-2*o*r/(o-r);else if(a===ur)m=-o/(o-r),x=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=d,c[12]=0,c[1]=0,c[5]=u,c[9]=f,c[13]=0,c[2]=0,c[6]=0,c[10]=m,c[14]=x,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(t,e,n,s,r,o,a=Sn,l=!1){let c=this.elements,h=2/(e-t),u=2/(n-s),d=-(e+t)/(e-t),f=-(n+s)/(n-s),m,x;if(l)m=1/(o-r),x=o/(o-r);else if(a===Sn)m=-2/(o-r),x=-(o+r)/(o-r);else if(a===ur)m=-1/(o-r),x=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=0,c[12]=d,c[1]=0,c[5]=u,c[9]=0,c[13]=f,c[2]=0,c[6]=0,c[10]=m,c[14]=x,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(t){let e=this.elements,n=t.elements;for(let s=0;s<16;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<16;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){let n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t[e+9]=n[9],t[e+10]=n[10],t[e+11]=n[11],t[e+12]=n[12],t[e+13]=n[13],t[e+14]=n[14],t[e+15]=n[15],t}},os=new O,An=new Qt,a0=new O(0,0,0),l0=new O(1,1,1),xi=new O,fo=new O,on=new O,Ed=new Qt,Ad=new cn,wi=class i{constructor(t=0,e=0,n=0,s=i.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=n,this._order=s}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,n,s=this._order){return this._x=t,this._y=e,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,n=!0){let s=t.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],h=s[9],u=s[2],d=s[6],f=s[10];switch(e){case"XYZ":this._y=Math.asin(qt(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,f),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(d,c),this._z=0);break;case"YXZ":this._x=Math.asin(-qt(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,f),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(qt(d,-1,1)),Math.abs(d)<.9999999?(this._y=Math.atan2(-u,f),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-qt(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(d,f),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(qt(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,f));break;case"XZY":this._z=Math.asin(-qt(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(d,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,f),this._y=0);break;default:Nt("Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,n===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,n){return Ed.makeRotationFromQuaternion(t),this.setFromRotationMatrix(Ed,e,n)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return Ad.setFromEuler(this),this.setFromQuaternion(Ad,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};wi.DEFAULT_ORDER="XYZ";var Ss=class{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}},c0=0,Cd=new O,as=new cn,ei=new Qt,po=new O,tr=new O,h0=new O,u0=new cn,Rd=new O(1,0,0),Pd=new O(0,1,0),Id=new O(0,0,1),Ld={type:"added"},d0={type:"removed"},ls={type:"childadded",child:null},Rc={type:"childremoved",child:null},un=class i extends Pn{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:c0++}),this.uuid=Ds(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=i.DEFAULT_UP.clone();let t=new O,e=new wi,n=new cn,s=new O(1,1,1);function r(){n.setFromEuler(e,!1)}function o(){e.setFromQuaternion(n,void 0,!1)}e._onChange(r),n._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new Qt},normalMatrix:{value:new Ft}}),this.matrix=new Qt,this.matrixWorld=new Qt,this.matrixAutoUpdate=i.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=i.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new Ss,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return as.setFromAxisAngle(t,e),this.quaternion.multiply(as),this}rotateOnWorldAxis(t,e){return as.setFromAxisAngle(t,e),this.quaternion.premultiply(as),this}rotateX(t){return this.rotateOnAxis(Rd,t)}rotateY(t){return this.rotateOnAxis(Pd,t)}rotateZ(t){return this.rotateOnAxis(Id,t)}translateOnAxis(t,e){return Cd.copy(t).applyQuaternion(this.quaternion),this.position.add(Cd.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(Rd,t)}translateY(t){return this.translateOnAxis(Pd,t)}translateZ(t){return this.translateOnAxis(Id,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(ei.copy(this.matrixWorld).invert())}lookAt(t,e,n){t.isVector3?po.copy(t):po.set(t,e,n);let s=this.parent;this.updateWorldMatrix(!0,!1),tr.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?ei.lookAt(tr,po,this.up):ei.lookAt(po,tr,this.up),this.quaternion.setFromRotationMatrix(ei),s&&(ei.extractRotation(s.matrixWorld),as.setFromRotationMatrix(ei),this.quaternion.premultiply(as.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(Ot("Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(Ld),ls.child=t,this.dispatchEvent(ls),ls.child=null):Ot("Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}let e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(d0),Rc.child=t,this.dispatchEvent(Rc),Rc.child=null),this}removeFromParent(){let t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),ei.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),ei.multiply(t.parent.matrixWorld)),t.applyMatrix4(ei),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(Ld),ls.child=t,this.dispatchEvent(ls),ls.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let n=0,s=this.children.length;n<s;n++){let o=this.children[n].getObjectByProperty(t,e);if(o!==void 0)return o}}getObjectsByProperty(t,e,n=[]){this[t]===e&&n.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(t,e,n);return n}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(tr,t,h0),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(tr,u0,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);let e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(t){t(this);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverseVisible(t)}traverseAncestors(t){let e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let t=this.pivot;if(t!==null){let e=t.x,n=t.y,s=t.z,r=this.matrix.elements;r[12]+=e-r[0]*e-r[4]*n-r[8]*s,r[13]+=n-r[1]*e-r[5]*n-r[9]*s,r[14]+=s-r[2]*e-r[6]*n-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].updateMatrixWorld(t)}updateWorldMatrix(t,e,n=!1){let s=this.parent;if(t===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||n)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,n=!0),e===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,n)}}toJSON(t){let e=t===void 0||typeof t=="string",n={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(t),s.indirectTexture=this._indirectTexture.toJSON(t),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(t)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(t.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(t.shapes,u)}else r(t.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(t.materials,this.material[l]));s.material=a}else s.material=r(t.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(t).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];s.animations.push(r(t.animations,l))}}if(e){let a=o(t.geometries),l=o(t.materials),c=o(t.textures),h=o(t.images),u=o(t.shapes),d=o(t.skeletons),f=o(t.animations),m=o(t.nodes);a.length>0&&(n.geometries=a),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),h.length>0&&(n.images=h),u.length>0&&(n.shapes=u),d.length>0&&(n.skeletons=d),f.length>0&&(n.animations=f),m.length>0&&(n.nodes=m)}return n.object=s,n;function o(a){let l=[];for(let c in a){let h=a[c];delete h.metadata,l.push(h)}return l}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.pivot=t.pivot!==null?t.pivot.clone():null,this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.static=t.static,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let n=0;n<t.children.length;n++){let s=t.children[n];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};un.DEFAULT_UP=new O(0,1,0);un.DEFAULT_MATRIX_AUTO_UPDATE=!0;un.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Gn=class extends un{constructor(){super(),this.isGroup=!0,this.type="Group"}},f0={type:"move"},ws=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Gn,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Gn,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new O,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new O),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Gn,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new O,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new O,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){let e=this._hand;if(e)for(let n of t.hand.values())this._getHandJoint(e,n)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,n){let s=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(c&&t.hand){o=!0;for(let x of t.hand.values()){let p=e.getJointPose(x,n),g=this._getHandJoint(c,x);p!==null&&(g.matrix.fromArray(p.transform.matrix),g.matrix.decompose(g.position,g.quaternion,g.scale),g.matrixWorldNeedsUpdate=!0,g.jointRadius=p.radius),g.visible=p!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],d=h.position.distanceTo(u.position),f=.02,m=.005;c.inputState.pinching&&d>f+m?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!c.inputState.pinching&&d<=f-m&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else l!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:t,target:this})));a!==null&&(s=e.getPose(t.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(f0)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){let n=new Gn;n.matrixAutoUpdate=!1,n.visible=!1,t.joints[e.jointName]=n,t.add(n)}return t.joints[e.jointName]}},Uf={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},vi={h:0,s:0,l:0},mo={h:0,s:0,l:0};function Pc(i,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?i+(t-i)*6*e:e<1/2?t:e<2/3?i+(t-i)*6*(2/3-e):i}var Bt=class{constructor(t,e,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,n)}set(t,e,n){if(e===void 0&&n===void 0){let s=t;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(t,e,n);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=ln){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,Kt.colorSpaceToWorking(this,e),this}setRGB(t,e,n,s=Kt.workingColorSpace){return this.r=t,this.g=e,this.b=n,Kt.colorSpaceToWorking(this,s),this}setHSL(t,e,n,s=Kt.workingColorSpace){if(t=Ch(t,1),e=qt(e,0,1),n=qt(n,0,1),e===0)this.r=this.g=this.b=n;else{let r=n<=.5?n*(1+e):n+e-n*e,o=2*n-r;this.r=Pc(o,r,t+1/3),this.g=Pc(o,r,t),this.b=Pc(o,r,t-1/3)}return Kt.colorSpaceToWorking(this,s),this}setStyle(t,e=ln){function n(r){r!==void 0&&parseFloat(r)<1&&Nt("Color: Alpha component of "+t+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(t)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,e);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:Nt("Color: Unknown color model "+t)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(t)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(o===6)return this.setHex(parseInt(r,16),e);Nt("Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=ln){let n=Uf[t.toLowerCase()];return n!==void 0?this.setHex(n,e):Nt("Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=oi(t.r),this.g=oi(t.g),this.b=oi(t.b),this}copyLinearToSRGB(t){return this.r=xs(t.r),this.g=xs(t.g),this.b=xs(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=ln){return Kt.workingToColorSpace(He.copy(this),t),Math.round(qt(He.r*255,0,255))*65536+Math.round(qt(He.g*255,0,255))*256+Math.round(qt(He.b*255,0,255))}getHexString(t=ln){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=Kt.workingColorSpace){Kt.workingToColorSpace(He.copy(this),e);let n=He.r,s=He.g,r=He.b,o=Math.max(n,s,r),a=Math.min(n,s,r),l,c,h=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=h<=.5?u/(o+a):u/(2-o-a),o){case n:l=(s-r)/u+(s<r?6:0);break;case s:l=(r-n)/u+2;break;case r:l=(n-s)/u+4;break}l/=6}return t.h=l,t.s=c,t.l=h,t}getRGB(t,e=Kt.workingColorSpace){return Kt.workingToColorSpace(He.copy(this),e),t.r=He.r,t.g=He.g,t.b=He.b,t}getStyle(t=ln){Kt.workingToColorSpace(He.copy(this),t);let e=He.r,n=He.g,s=He.b;return t!==ln?`color(${t} ${e.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(t,e,n){return this.getHSL(vi),this.setHSL(vi.h+t,vi.s+e,vi.l+n)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,n){return this.r=t.r+(e.r-t.r)*n,this.g=t.g+(e.g-t.g)*n,this.b=t.b+(e.b-t.b)*n,this}lerpHSL(t,e){this.getHSL(vi),t.getHSL(mo);let n=ar(vi.h,mo.h,e),s=ar(vi.s,mo.s,e),r=ar(vi.l,mo.l,e);return this.setHSL(n,s,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){let e=this.r,n=this.g,s=this.b,r=t.elements;return this.r=r[0]*e+r[3]*n+r[6]*s,this.g=r[1]*e+r[4]*n+r[7]*s,this.b=r[2]*e+r[5]*n+r[8]*s,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},He=new Bt;Bt.NAMES=Uf;var pr=class extends un{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new wi,this.environmentIntensity=1,this.environmentRotation=new wi,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),this.background=t.background!==null?t.background.clone():null,this.environment=t.environment!==null?t.environment.clone():null,this.fog=t.fog!==null?t.fog.clone():null,this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),this.overrideMaterial=t.overrideMaterial!==null?t.overrideMaterial.clone():null,this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){let e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),e.object.backgroundBlurriness=this.backgroundBlurriness,e.object.backgroundIntensity=this.backgroundIntensity,e.object.backgroundRotation=this.backgroundRotation.toArray(),e.object.environmentIntensity=this.environmentIntensity,e.object.environmentRotation=this.environmentRotation.toArray(),e}},Cn=new O,ni=new O,Ic=new O,ii=new O,cs=new O,hs=new O,Dd=new O,Lc=new O,Dc=new O,Nc=new O,Oc=new _e,Uc=new _e,Fc=new _e,Si=class i{constructor(t=new O,e=new O,n=new O){this.a=t,this.b=e,this.c=n}static getNormal(t,e,n,s){s.subVectors(n,e),Cn.subVectors(t,e),s.cross(Cn);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(t,e,n,s,r){Cn.subVectors(s,e),ni.subVectors(n,e),Ic.subVectors(t,e);let o=Cn.dot(Cn),a=Cn.dot(ni),l=Cn.dot(Ic),c=ni.dot(ni),h=ni.dot(Ic),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let d=1/u,f=(c*l-a*h)*d,m=(o*h-a*l)*d;return r.set(1-f-m,m,f)}static containsPoint(t,e,n,s){return this.getBarycoord(t,e,n,s,ii)===null?!1:ii.x>=0&&ii.y>=0&&ii.x+ii.y<=1}static getInterpolation(t,e,n,s,r,o,a,l){return this.getBarycoord(t,e,n,s,ii)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,ii.x),l.addScaledVector(o,ii.y),l.addScaledVector(a,ii.z),l)}static getInterpolatedAttribute(t,e,n,s,r,o){return Oc.setScalar(0),Uc.setScalar(0),Fc.setScalar(0),Oc.fromBufferAttribute(t,e),Uc.fromBufferAttribute(t,n),Fc.fromBufferAttribute(t,s),o.setScalar(0),o.addScaledVector(Oc,r.x),o.addScaledVector(Uc,r.y),o.addScaledVector(Fc,r.z),o}static isFrontFacing(t,e,n,s){return Cn.subVectors(n,e),ni.subVectors(t,e),Cn.cross(ni).dot(s)<0}set(t,e,n){return this.a.copy(t),this.b.copy(e),this.c.copy(n),this}setFromPointsAndIndices(t,e,n,s){return this.a.copy(t[e]),this.b.copy(t[n]),this.c.copy(t[s]),this}setFromAttributeAndIndices(t,e,n,s){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,n),this.c.fromBufferAttribute(t,s),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return Cn.subVectors(this.c,this.b),ni.subVectors(this.a,this.b),Cn.cross(ni).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return i.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return i.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,n,s,r){return i.getInterpolation(t,this.a,this.b,this.c,e,n,s,r)}containsPoint(t){return i.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return i.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){let n=this.a,s=this.b,r=this.c,o,a;cs.subVectors(s,n),hs.subVectors(r,n),Lc.subVectors(t,n);let l=cs.dot(Lc),c=hs.dot(Lc);if(l<=0&&c<=0)return e.copy(n);Dc.subVectors(t,s);let h=cs.dot(Dc),u=hs.dot(Dc);if(h>=0&&u<=h)return e.copy(s);let d=l*u-h*c;if(d<=0&&l>=0&&h<=0&&l-h>0)return o=l/(l-h),e.copy(n).addScaledVector(cs,o);Nc.subVectors(t,r);let f=cs.dot(Nc),m=hs.dot(Nc);if(m>=0&&f<=m)return e.copy(r);let x=f*c-l*m;if(x<=0&&c>=0&&m<=0)return a=c/(c-m),e.copy(n).addScaledVector(hs,a);let p=h*m-f*u;if(p<=0&&u-h>=0&&f-m>=0)return Dd.subVectors(r,s),a=(u-h)/(u-h+(f-m)),e.copy(s).addScaledVector(Dd,a);let g=1/(p+x+d);return o=x*g,a=d*g,e.copy(n).addScaledVector(cs,o).addScaledVector(hs,a)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}},In=class{constructor(t=new O(1/0,1/0,1/0),e=new O(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e+=3)this.expandByPoint(Rn.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,n=t.count;e<n;e++)this.expandByPoint(Rn.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){let n=Rn.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(n),this.max.copy(t).add(n),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);let n=t.geometry;if(n!==void 0){let r=n.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0&&t.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)t.isMesh===!0?t.getVertexPosition(o,Rn):Rn.fromBufferAttribute(r,o),Rn.applyMatrix4(t.matrixWorld),this.expandByPoint(Rn);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),go.copy(t.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),go.copy(n.boundingBox)),go.applyMatrix4(t.matrixWorld),this.union(go)}let s=t.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,Rn),Rn.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,n;return t.normal.x>0?(e=t.normal.x*this.min.x,n=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,n=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,n+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,n+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,n+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,n+=t.normal.z*this.min.z),e<=-t.constant&&n>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(er),_o.subVectors(this.max,er),us.subVectors(t.a,er),ds.subVectors(t.b,er),fs.subVectors(t.c,er),yi.subVectors(ds,us),Mi.subVectors(fs,ds),Vi.subVectors(us,fs);let e=[0,-yi.z,yi.y,0,-Mi.z,Mi.y,0,-Vi.z,Vi.y,yi.z,0,-yi.x,Mi.z,0,-Mi.x,Vi.z,0,-Vi.x,-yi.y,yi.x,0,-Mi.y,Mi.x,0,-Vi.y,Vi.x,0];return!Bc(e,us,ds,fs,_o)||(e=[1,0,0,0,1,0,0,0,1],!Bc(e,us,ds,fs,_o))?!1:(xo.crossVectors(yi,Mi),e=[xo.x,xo.y,xo.z],Bc(e,us,ds,fs,_o))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,Rn).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(Rn).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(si[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),si[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),si[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),si[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),si[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),si[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),si[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),si[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(si),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(t){return this.min.fromArray(t.min),this.max.fromArray(t.max),this}},si=[new O,new O,new O,new O,new O,new O,new O,new O],Rn=new O,go=new In,us=new O,ds=new O,fs=new O,yi=new O,Mi=new O,Vi=new O,er=new O,_o=new O,xo=new O,Hi=new O;function Bc(i,t,e,n,s){for(let r=0,o=i.length-3;r<=o;r+=3){Hi.fromArray(i,r);let a=s.x*Math.abs(Hi.x)+s.y*Math.abs(Hi.y)+s.z*Math.abs(Hi.z),l=t.dot(Hi),c=e.dot(Hi),h=n.dot(Hi);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}var we=new O,vo=new Dt,p0=0,Te=class extends Pn{constructor(t,e,n=!1){if(super(),Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:p0++}),this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=n,this.usage=Rf,this.updateRanges=[],this.gpuType=pn,this.version=0,this._normalizationScale=t!==void 0?Ph(t):void 0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this._normalizationScale=t._normalizationScale,this}copyAt(t,e,n){t*=this.itemSize,n*=e.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[t+s]=e.array[n+s];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,n=this.count;e<n;e++)vo.fromBufferAttribute(this,e),vo.applyMatrix3(t),this.setXY(e,vo.x,vo.y);else if(this.itemSize===3)for(let e=0,n=this.count;e<n;e++)we.fromBufferAttribute(this,e),we.applyMatrix3(t),this.setXYZ(e,we.x,we.y,we.z);return this}applyMatrix4(t){for(let e=0,n=this.count;e<n;e++)we.fromBufferAttribute(this,e),we.applyMatrix4(t),this.setXYZ(e,we.x,we.y,we.z);return this}applyNormalMatrix(t){for(let e=0,n=this.count;e<n;e++)we.fromBufferAttribute(this,e),we.applyNormalMatrix(t),this.setXYZ(e,we.x,we.y,we.z);return this}transformDirection(t){for(let e=0,n=this.count;e<n;e++)we.fromBufferAttribute(this,e),we.transformDirection(t),this.setXYZ(e,we.x,we.y,we.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let n=this.array[t*this.itemSize+e];return this.normalized&&(n=this._denormalize(n)),n}setComponent(t,e,n){return this.normalized&&(n=this._normalize(n)),this.array[t*this.itemSize+e]=n,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=this._denormalize(e)),e}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=this._denormalize(e)),e}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=this._denormalize(e)),e}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=this._denormalize(e)),e}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,n){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n)),this.array[t+0]=e,this.array[t+1]=n,this}setXYZ(t,e,n,s){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n),s=this._normalize(s)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this}setXYZW(t,e,n,s,r){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return t.name=this.name,t.usage=this.usage,t.gpuType=this.gpuType,t}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):Nf(t,this.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):Of(t,this.array)}};var mr=class extends Te{constructor(t,e,n){super(new Uint16Array(t),e,n)}};var gr=class extends Te{constructor(t,e,n){super(new Uint32Array(t),e,n)}};var Ye=class extends Te{constructor(t,e,n){super(new Float32Array(t),e,n)}},m0=new In,nr=new O,kc=new O,dn=class{constructor(t=new O,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){let n=this.center;e!==void 0?n.copy(e):m0.setFromPoints(t).getCenter(n);let s=0;for(let r=0,o=t.length;r<o;r++)s=Math.max(s,n.distanceToSquared(t[r]));return this.radius=Math.sqrt(s),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){let e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){let n=this.center.distanceToSquared(t);return e.copy(t),n>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;nr.subVectors(t,this.center);let e=nr.lengthSq();if(e>this.radius*this.radius){let n=Math.sqrt(e),s=(n-this.radius)*.5;this.center.addScaledVector(nr,s/n),this.radius+=s}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(kc.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(nr.copy(t.center).add(kc)),this.expandByPoint(nr.copy(t.center).sub(kc))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(t){return this.radius=t.radius,this.center.fromArray(t.center),this}},g0=0,bn=new Qt,zc=new un,ps=new O,an=new In,ir=new In,Ne=new O,tn=class i extends Pn{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:g0++}),this.uuid=Ds(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(Gg(t)?gr:mr)(t,1):this.index=t,this}setIndirect(t,e=0){return this.indirect=t,this.indirectOffset=e,this}getIndirect(){return this.indirect}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,n=0){this.groups.push({start:t,count:e,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){let e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);let n=this.attributes.normal;if(n!==void 0){let r=new Ft().getNormalMatrix(t);n.applyNormalMatrix(r),n.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(t),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(t){return bn.makeRotationFromQuaternion(t),this.applyMatrix4(bn),this}rotateX(t){return bn.makeRotationX(t),this.applyMatrix4(bn),this}rotateY(t){return bn.makeRotationY(t),this.applyMatrix4(bn),this}rotateZ(t){return bn.makeRotationZ(t),this.applyMatrix4(bn),this}translate(t,e,n){return bn.makeTranslation(t,e,n),this.applyMatrix4(bn),this}scale(t,e,n){return bn.makeScale(t,e,n),this.applyMatrix4(bn),this}lookAt(t){return zc.lookAt(t),zc.updateMatrix(),this.applyMatrix4(zc.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(ps).negate(),this.translate(ps.x,ps.y,ps.z),this}setFromPoints(t){let e=this.getAttribute("position");if(e===void 0){let n=[];for(let s=0,r=t.length;s<r;s++){let o=t[s];n.push(o.x,o.y,o.z||0)}this.setAttribute("position",new Ye(n,3))}else{let n=Math.min(t.length,e.count);for(let s=0;s<n;s++){let r=t[s];e.setXYZ(s,r.x,r.y,r.z||0)}t.length>e.count&&Nt("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),e.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new In);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Ot("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new O(-1/0,-1/0,-1/0),new O(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let n=0,s=e.length;n<s;n++){let r=e[n];an.setFromBufferAttribute(r),this.morphTargetsRelative?(Ne.addVectors(this.boundingBox.min,an.min),this.boundingBox.expandByPoint(Ne),Ne.addVectors(this.boundingBox.max,an.max),this.boundingBox.expandByPoint(Ne)):(this.boundingBox.expandByPoint(an.min),this.boundingBox.expandByPoint(an.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&Ot('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new dn);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Ot("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new O,1/0);return}if(t){let n=this.boundingSphere.center;if(an.setFromBufferAttribute(t),e)for(let r=0,o=e.length;r<o;r++){let a=e[r];ir.setFromBufferAttribute(a),this.morphTargetsRelative?(Ne.addVectors(an.min,ir.min),an.expandByPoint(Ne),Ne.addVectors(an.max,ir.max),an.expandByPoint(Ne)):(an.expandByPoint(ir.min),an.expandByPoint(ir.max))}an.getCenter(n);let s=0;for(let r=0,o=t.count;r<o;r++)Ne.fromBufferAttribute(t,r),s=Math.max(s,n.distanceToSquared(Ne));if(e)for(let r=0,o=e.length;r<o;r++){let a=e[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)Ne.fromBufferAttribute(a,c),l&&(ps.fromBufferAttribute(t,c),Ne.add(ps)),s=Math.max(s,n.distanceToSquared(Ne))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&Ot('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){Ot("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let n=e.position,s=e.normal,r=e.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==n.count)&&(o=new Te(new Float32Array(4*n.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(n.count);for(let F=0;F<n.count;F++)a[F]=new O,l[F]=new O;let h=new O,u=new O,d=new O,f=new Dt,m=new Dt,x=new Dt,p=new O,g=new O;function S(F,L,N){c[F]=c[L]=c[N]=1,h.fromBufferAttribute(n,F),u.fromBufferAttribute(n,L),d.fromBufferAttribute(n,N),f.fromBufferAttribute(r,F),m.fromBufferAttribute(r,L),x.fromBufferAttribute(r,N),u.sub(h),d.sub(h),m.sub(f),x.sub(f);let z=1/(m.x*x.y-x.x*m.y);isFinite(z)&&(p.copy(u).multiplyScalar(x.y).addScaledVector(d,-m.y).multiplyScalar(z),g.copy(d).multiplyScalar(m.x).addScaledVector(u,-x.x).multiplyScalar(z),a[F].add(p),a[L].add(p),a[N].add(p),l[F].add(g),l[L].add(g),l[N].add(g))}let w=this.groups;w.length===0&&(w=[{start:0,count:t.count}]);for(let F=0,L=w.length;F<L;++F){let N=w[F],z=N.start,Y=N.count;for(let I=z,X=z+Y;I<X;I+=3)S(t.getX(I+0),t.getX(I+1),t.getX(I+2))}let b=new O,C=new O,A=new O,_=new O;function T(F){A.fromBufferAttribute(s,F),_.copy(A);let L=a[F];b.copy(L),b.sub(A.multiplyScalar(A.dot(L))).normalize(),C.crossVectors(_,L);let z=C.dot(l[F])<0?-1:1;o.setXYZW(F,b.x,b.y,b.z,z)}for(let F=0,L=n.count;F<L;++F)c[F]&&T(F);this._transformed=!0}computeVertexNormals(){let t=this.index,e=this.getAttribute("position");if(e!==void 0){let n=this.getAttribute("normal");if(n===void 0||n.count!==e.count)n=new Te(new Float32Array(e.count*3),3),this.setAttribute("normal",n);else for(let d=0,f=n.count;d<f;d++)n.setXYZ(d,0,0,0);let s=new O,r=new O,o=new O,a=new O,l=new O,c=new O,h=new O,u=new O;if(t)for(let d=0,f=t.count;d<f;d+=3){let m=t.getX(d+0),x=t.getX(d+1),p=t.getX(d+2);s.fromBufferAttribute(e,m),r.fromBufferAttribute(e,x),o.fromBufferAttribute(e,p),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),a.fromBufferAttribute(n,m),l.fromBufferAttribute(n,x),c.fromBufferAttribute(n,p),a.add(h),l.add(h),c.add(h),n.setXYZ(m,a.x,a.y,a.z),n.setXYZ(x,l.x,l.y,l.z),n.setXYZ(p,c.x,c.y,c.z)}else for(let d=0,f=e.count;d<f;d+=3)s.fromBufferAttribute(e,d+0),r.fromBufferAttribute(e,d+1),o.fromBufferAttribute(e,d+2),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),n.setXYZ(d+0,h.x,h.y,h.z),n.setXYZ(d+1,h.x,h.y,h.z),n.setXYZ(d+2,h.x,h.y,h.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){let t=this.attributes.normal;for(let e=0,n=t.count;e<n;e++)Ne.fromBufferAttribute(t,e),Ne.normalize(),t.setXYZ(e,Ne.x,Ne.y,Ne.z)}toNonIndexed(){function t(a,l){let c=a.array,h=a.itemSize,u=a.normalized,d=new c.constructor(l.length*h),f=0,m=0;for(let x=0,p=l.length;x<p;x++){a.isInterleavedBufferAttribute?f=l[x]*a.data.stride+a.offset:f=l[x]*h;for(let g=0;g<h;g++)d[m++]=c[f++]}return new Te(d,h,u)}if(this.index===null)return Nt("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let e=new i,n=this.index.array,s=this.attributes;for(let a in s){let l=s[a],c=t(l,n);e.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let h=0,u=c.length;h<u;h++){let d=c[h],f=t(d,n);l.push(f)}e.morphAttributes[a]=l}e.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];e.addGroup(c.start,c.count,c.materialIndex)}return e}toJSON(){let t={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,t.name=this.name,Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(t[c]=l[c]);return t}t.data={attributes:{}};let e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});let n=this.attributes;for(let l in n){let c=n[l];t.data.attributes[l]=c.toJSON(t.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,d=c.length;u<d;u++){let f=c[u];h.push(f.toJSON(t.data))}h.length>0&&(s[l]=h,r=!0)}r&&(t.data.morphAttributes=s,t.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(t.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(t.data.boundingSphere=a.toJSON()),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let e={};this.name=t.name;let n=t.index;n!==null&&this.setIndex(n.clone());let s=t.attributes;for(let c in s){let h=s[c];this.setAttribute(c,h.clone(e))}let r=t.morphAttributes;for(let c in r){let h=[],u=r[c];for(let d=0,f=u.length;d<f;d++)h.push(u[d].clone(e));this.morphAttributes[c]=h}this.morphTargetsRelative=t.morphTargetsRelative;let o=t.groups;for(let c=0,h=o.length;c<h;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=t.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=t.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this._transformed=t._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}};var Gc=new O,_0=new O,x0=new Ft,qe=class{constructor(t=new O(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,n,s){return this.normal.set(t,e,n),this.constant=s,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,n){let s=Gc.subVectors(n,e).cross(_0.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(s,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){let t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e,n=!0){let s=t.delta(Gc),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;let o=-(t.start.dot(this.normal)+this.constant)/r;return n===!0&&(o<0||o>1)?null:e.copy(t.start).addScaledVector(s,o)}intersectsLine(t){let e=this.distanceToPoint(t.start),n=this.distanceToPoint(t.end);return e<0&&n>0||n<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){let n=e||x0.getNormalMatrix(t),s=this.coplanarPoint(Gc).applyMatrix4(t),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(t){return this.normal.fromArray(t.normal),this.constant=t.constant,this}},v0=0,Ti=class extends Pn{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:v0++}),this.uuid=Ds(),this.name="",this.type="Material",this.blending=Ps,this.side=Di,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=rh,this.blendDst=oh,this.blendEquation=Zi,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new Bt(0,0,0),this.blendAlpha=0,this.depthFunc=vs,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=Sf,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=Bo,this.stencilZFail=Bo,this.stencilZPass=Bo,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(let e in t){let n=t[e];if(n===void 0){Nt(`Material: parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){Nt(`Material: '${e}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector2&&n&&n.isVector2||s&&s.isEuler&&n&&n.isEuler||s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[e]=n}}toJSON(t){let e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});let n={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,n.blending=this.blending,n.side=this.side,n.shadowSide=this.shadowSide,n.vertexColors=this.vertexColors,n.opacity=this.opacity,n.transparent=this.transparent,n.blendSrc=this.blendSrc,n.blendDst=this.blendDst,n.blendEquation=this.blendEquation,n.blendSrcAlpha=this.blendSrcAlpha,n.blendDstAlpha=this.blendDstAlpha,n.blendEquationAlpha=this.blendEquationAlpha,n.blendColor=this.blendColor.getHex(),n.blendAlpha=this.blendAlpha,n.depthFunc=this.depthFunc,n.depthTest=this.depthTest,n.depthWrite=this.depthWrite,n.colorWrite=this.colorWrite,n.clipIntersection=this.clipIntersection,n.clipShadows=this.clipShadows,n.stencilWriteMask=this.stencilWriteMask,n.stencilFunc=this.stencilFunc,n.stencilRef=this.stencilRef,n.stencilFuncMask=this.stencilFuncMask,n.stencilFail=this.stencilFail,n.stencilZFail=this.stencilZFail,n.stencilZPass=this.stencilZPass,n.stencilWrite=this.stencilWrite,n.polygonOffset=this.polygonOffset,n.polygonOffsetFactor=this.polygonOffsetFactor,n.polygonOffsetUnits=this.polygonOffsetUnits,n.dithering=this.dithering,n.alphaTest=this.alphaTest,n.alphaHash=this.alphaHash,n.alphaToCoverage=this.alphaToCoverage,n.premultipliedAlpha=this.premultipliedAlpha,n.forceSinglePass=this.forceSinglePass,n.allowOverride=this.allowOverride,n.visible=this.visible,n.toneMapped=this.toneMapped,n.name=this.name,this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(n.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(n.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(t).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(n.sheenColorMap=this.sheenColorMap.toJSON(t).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(n.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(t).uuid),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(n.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(n.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(n.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(t).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(t).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(t).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(t).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(t).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(n.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(n.rotation=this.rotation),this.depthPacking!==void 0&&(n.depthPacking=this.depthPacking),this.linewidth!==void 0&&(n.linewidth=this.linewidth),this.linecap!==void 0&&(n.linecap=this.linecap),this.linejoin!==void 0&&(n.linejoin=this.linejoin),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.wireframe!==void 0&&(n.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(n.flatShading=this.flatShading),this.fog!==void 0&&(n.fog=this.fog),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(e){let r=s(t.textures),o=s(t.images);r.length>0&&(n.textures=r),o.length>0&&(n.images=o)}return n}fromJSON(t,e){if(t.uuid!==void 0&&(this.uuid=t.uuid),t.name!==void 0&&(this.name=t.name),t.color!==void 0&&this.color!==void 0&&this.color.setHex(t.color),t.roughness!==void 0&&(this.roughness=t.roughness),t.metalness!==void 0&&(this.metalness=t.metalness),t.sheen!==void 0&&(this.sheen=t.sheen),t.sheenColor!==void 0&&(this.sheenColor=new Bt().setHex(t.sheenColor)),t.sheenRoughness!==void 0&&(this.sheenRoughness=t.sheenRoughness),t.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(t.emissive),t.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(t.specular),t.specularIntensity!==void 0&&(this.specularIntensity=t.specularIntensity),t.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(t.specularColor),t.shininess!==void 0&&(this.shininess=t.shininess),t.clearcoat!==void 0&&(this.clearcoat=t.clearcoat),t.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=t.clearcoatRoughness),t.diffuseRoughness!==void 0&&(this.diffuseRoughness=t.diffuseRoughness),t.dispersion!==void 0&&(this.dispersion=t.dispersion),t.retroreflectivity!==void 0&&(this.retroreflectivity=t.retroreflectivity),t.iridescence!==void 0&&(this.iridescence=t.iridescence),t.iridescenceIOR!==void 0&&(this.iridescenceIOR=t.iridescenceIOR),t.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessMinimum),t.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=t.iridescenceThicknessMaximum),t.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=t.iridescenceThicknessRange[1]),t.transmission!==void 0&&(this.transmission=t.transmission),t.thickness!==void 0&&(this.thickness=t.thickness),t.attenuationDistance!==void 0&&(this.attenuationDistance=t.attenuationDistance),t.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(t.attenuationColor),t.anisotropy!==void 0&&(this.anisotropy=t.anisotropy),t.anisotropyRotation!==void 0&&(this.anisotropyRotation=t.anisotropyRotation),t.fog!==void 0&&(this.fog=t.fog),t.flatShading!==void 0&&(this.flatShading=t.flatShading),t.blending!==void 0&&(this.blending=t.blending),t.combine!==void 0&&(this.combine=t.combine),t.side!==void 0&&(this.side=t.side),t.shadowSide!==void 0&&(this.shadowSide=t.shadowSide),t.opacity!==void 0&&(this.opacity=t.opacity),t.transparent!==void 0&&(this.transparent=t.transparent),t.alphaTest!==void 0&&(this.alphaTest=t.alphaTest),t.alphaHash!==void 0&&(this.alphaHash=t.alphaHash),t.depthFunc!==void 0&&(this.depthFunc=t.depthFunc),t.depthTest!==void 0&&(this.depthTest=t.depthTest),t.depthWrite!==void 0&&(this.depthWrite=t.depthWrite),t.colorWrite!==void 0&&(this.colorWrite=t.colorWrite),t.clippingPlanes!==void 0&&(this.clippingPlanes=t.clippingPlanes.map(n=>new qe().fromJSON(n))),t.clipIntersection!==void 0&&(this.clipIntersection=t.clipIntersection),t.clipShadows!==void 0&&(this.clipShadows=t.clipShadows),t.depthPacking!==void 0&&(this.depthPacking=t.depthPacking),t.blendSrc!==void 0&&(this.blendSrc=t.blendSrc),t.blendDst!==void 0&&(this.blendDst=t.blendDst),t.blendEquation!==void 0&&(this.blendEquation=t.blendEquation),t.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=t.blendSrcAlpha),t.blendDstAlpha!==void 0&&(this.blendDstAlpha=t.blendDstAlpha),t.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=t.blendEquationAlpha),t.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(t.blendColor),t.blendAlpha!==void 0&&(this.blendAlpha=t.blendAlpha),t.stencilWriteMask!==void 0&&(this.stencilWriteMask=t.stencilWriteMask),t.stencilFunc!==void 0&&(this.stencilFunc=t.stencilFunc),t.stencilRef!==void 0&&(this.stencilRef=t.stencilRef),t.stencilFuncMask!==void 0&&(this.stencilFuncMask=t.stencilFuncMask),t.stencilFail!==void 0&&(this.stencilFail=t.stencilFail),t.stencilZFail!==void 0&&(this.stencilZFail=t.stencilZFail),t.stencilZPass!==void 0&&(this.stencilZPass=t.stencilZPass),t.stencilWrite!==void 0&&(this.stencilWrite=t.stencilWrite),t.wireframe!==void 0&&(this.wireframe=t.wireframe),t.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=t.wireframeLinewidth),t.wireframeLinecap!==void 0&&(this.wireframeLinecap=t.wireframeLinecap),t.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=t.wireframeLinejoin),t.rotation!==void 0&&(this.rotation=t.rotation),t.linewidth!==void 0&&(this.linewidth=t.linewidth),t.linecap!==void 0&&(this.linecap=t.linecap),t.linejoin!==void 0&&(this.linejoin=t.linejoin),t.dashSize!==void 0&&(this.dashSize=t.dashSize),t.gapSize!==void 0&&(this.gapSize=t.gapSize),t.scale!==void 0&&(this.scale=t.scale),t.polygonOffset!==void 0&&(this.polygonOffset=t.polygonOffset),t.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=t.polygonOffsetFactor),t.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=t.polygonOffsetUnits),t.dithering!==void 0&&(this.dithering=t.dithering),t.alphaToCoverage!==void 0&&(this.alphaToCoverage=t.alphaToCoverage),t.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=t.premultipliedAlpha),t.forceSinglePass!==void 0&&(this.forceSinglePass=t.forceSinglePass),t.allowOverride!==void 0&&(this.allowOverride=t.allowOverride),t.visible!==void 0&&(this.visible=t.visible),t.toneMapped!==void 0&&(this.toneMapped=t.toneMapped),t.userData!==void 0&&(this.userData=t.userData),t.vertexColors!==void 0&&(typeof t.vertexColors=="number"?this.vertexColors=t.vertexColors>0:this.vertexColors=t.vertexColors),t.size!==void 0&&(this.size=t.size),t.sizeAttenuation!==void 0&&(this.sizeAttenuation=t.sizeAttenuation),t.map!==void 0&&(this.map=e[t.map]||null),t.matcap!==void 0&&(this.matcap=e[t.matcap]||null),t.alphaMap!==void 0&&(this.alphaMap=e[t.alphaMap]||null),t.bumpMap!==void 0&&(this.bumpMap=e[t.bumpMap]||null),t.bumpScale!==void 0&&(this.bumpScale=t.bumpScale),t.normalMap!==void 0&&(this.normalMap=e[t.normalMap]||null),t.normalMapType!==void 0&&(this.normalMapType=t.normalMapType),t.normalScale!==void 0){let n=t.normalScale;Array.isArray(n)===!1&&(n=[n,n]),this.normalScale=new Dt().fromArray(n)}return t.displacementMap!==void 0&&(this.displacementMap=e[t.displacementMap]||null),t.displacementScale!==void 0&&(this.displacementScale=t.displacementScale),t.displacementBias!==void 0&&(this.displacementBias=t.displacementBias),t.roughnessMap!==void 0&&(this.roughnessMap=e[t.roughnessMap]||null),t.metalnessMap!==void 0&&(this.metalnessMap=e[t.metalnessMap]||null),t.emissiveMap!==void 0&&(this.emissiveMap=e[t.emissiveMap]||null),t.emissiveIntensity!==void 0&&(this.emissiveIntensity=t.emissiveIntensity),t.specularMap!==void 0&&(this.specularMap=e[t.specularMap]||null),t.specularIntensityMap!==void 0&&(this.specularIntensityMap=e[t.specularIntensityMap]||null),t.specularColorMap!==void 0&&(this.specularColorMap=e[t.specularColorMap]||null),t.envMap!==void 0&&(this.envMap=e[t.envMap]||null),t.envMapRotation!==void 0&&this.envMapRotation.fromArray(t.envMapRotation),t.envMapIntensity!==void 0&&(this.envMapIntensity=t.envMapIntensity),t.reflectivity!==void 0&&(this.reflectivity=t.reflectivity),t.refractionRatio!==void 0&&(this.refractionRatio=t.refractionRatio),t.lightMap!==void 0&&(this.lightMap=e[t.lightMap]||null),t.lightMapIntensity!==void 0&&(this.lightMapIntensity=t.lightMapIntensity),t.aoMap!==void 0&&(this.aoMap=e[t.aoMap]||null),t.aoMapIntensity!==void 0&&(this.aoMapIntensity=t.aoMapIntensity),t.gradientMap!==void 0&&(this.gradientMap=e[t.gradientMap]||null),t.clearcoatMap!==void 0&&(this.clearcoatMap=e[t.clearcoatMap]||null),t.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=e[t.clearcoatRoughnessMap]||null),t.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=e[t.clearcoatNormalMap]||null),t.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new Dt().fromArray(t.clearcoatNormalScale)),t.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=e[t.diffuseRoughnessMap]||null),t.iridescenceMap!==void 0&&(this.iridescenceMap=e[t.iridescenceMap]||null),t.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=e[t.iridescenceThicknessMap]||null),t.transmissionMap!==void 0&&(this.transmissionMap=e[t.transmissionMap]||null),t.thicknessMap!==void 0&&(this.thicknessMap=e[t.thicknessMap]||null),t.anisotropyMap!==void 0&&(this.anisotropyMap=e[t.anisotropyMap]||null),t.sheenColorMap!==void 0&&(this.sheenColorMap=e[t.sheenColorMap]||null),t.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=e[t.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;let e=t.clippingPlanes,n=null;if(e!==null){let s=e.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=e[r].clone()}return this.clippingPlanes=n,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.allowOverride=t.allowOverride,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}};var ri=new O,Vc=new O,yo=new O,Mo=new O,Vn=class{constructor(t=new O,e=new O(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,ri)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);let n=e.dot(this.direction);return n<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){let e=ri.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(ri.copy(this.origin).addScaledVector(this.direction,e),ri.distanceToSquared(t))}distanceSqToSegment(t,e,n,s){Vc.copy(t).add(e).multiplyScalar(.5),yo.copy(e).sub(t).normalize(),Mo.copy(this.origin).sub(Vc);let r=t.distanceTo(e)*.5,o=-this.direction.dot(yo),a=Mo.dot(this.direction),l=-Mo.dot(yo),c=Mo.lengthSq(),h=Math.abs(1-o*o),u,d,f,m;if(h>0)if(u=o*l-a,d=o*a-l,m=r*h,u>=0)if(d>=-m)if(d<=m){let x=1/h;u*=x,d*=x,f=u*(u+o*d+2*a)+d*(o*u+d+2*l)+c}else d=r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d=-r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d<=-m?(u=Math.max(0,-(-o*r+a)),d=u>0?-r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c):d<=m?(u=0,d=Math.min(Math.max(-r,-l),r),f=d*(d+2*l)+c):(u=Math.max(0,-(o*r+a)),d=u>0?r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c);else d=o>0?-r:r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(Vc).addScaledVector(yo,d),f}intersectSphere(t,e){if(t.radius<0)return null;ri.subVectors(t.center,this.origin);let n=ri.dot(this.direction),s=ri.dot(ri)-n*n,r=t.radius*t.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=n-o,l=n+o;return l<0?null:a<0?this.at(l,e):this.at(a,e)}intersectsSphere(t){return t.radius<0?!1:this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){let e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;let n=-(this.origin.dot(t.normal)+t.constant)/e;return n>=0?n:null}intersectPlane(t,e){let n=this.distanceToPlane(t);return n===null?null:this.at(n,e)}intersectsPlane(t){let e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let n,s,r,o,a,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,d=this.origin;return c>=0?(n=(t.min.x-d.x)*c,s=(t.max.x-d.x)*c):(n=(t.max.x-d.x)*c,s=(t.min.x-d.x)*c),h>=0?(r=(t.min.y-d.y)*h,o=(t.max.y-d.y)*h):(r=(t.max.y-d.y)*h,o=(t.min.y-d.y)*h),n>o||r>s||((r>n||isNaN(n))&&(n=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(t.min.z-d.z)*u,l=(t.max.z-d.z)*u):(a=(t.max.z-d.z)*u,l=(t.min.z-d.z)*u),n>l||a>s)||((a>n||n!==n)&&(n=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,e)}intersectsBox(t){return this.intersectBox(t,ri)!==null}intersectTriangle(t,e,n,s,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,h=a.z,u=t.x-o.x,d=t.y-o.y,f=t.z-o.z,m=e.x-o.x,x=e.y-o.y,p=e.z-o.z,g=n.x-o.x,S=n.y-o.y,w=n.z-o.z,b=Math.abs(l),C=Math.abs(c),A=Math.abs(h),_,T,F,L,N,z,Y,I,X,$,V,it;if(b>=C&&b>=A?(F=l,z=u,X=m,it=g,l>=0?(_=c,T=h,L=d,N=f,Y=x,I=p,$=S,V=w):(_=h,T=c,L=f,N=d,Y=p,I=x,$=w,V=S)):C>=A?(F=c,z=d,X=x,it=S,c>=0?(_=h,T=l,L=f,N=u,Y=p,I=m,$=w,V=g):(_=l,T=h,L=u,N=f,Y=m,I=p,$=g,V=w)):(F=h,z=f,X=p,it=w,h>=0?(_=l,T=c,L=u,N=d,Y=m,I=x,$=g,V=S):(_=c,T=l,L=d,N=u,Y=x,I=m,$=S,V=g)),F===0)return null;let W=_/F,tt=T/F,et=1/F,Mt=L-W*z,It=N-tt*z,J=Y-W*X,pt=I-tt*X,yt=$-W*it,Ct=V-tt*it,gt=yt*pt-Ct*J,Ut=Mt*Ct-It*yt,xe=J*It-pt*Mt;if(s){if(gt<0||Ut<0||xe<0)return null}else if((gt<0||Ut<0||xe<0)&&(gt>0||Ut>0||xe>0))return null;let Pt=gt+Ut+xe;if(Pt===0)return null;let te=et*(gt*z+Ut*X+xe*it);return(Pt>0?te<0:te>0)?null:this.at(te/Pt,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},jo=class extends Ti{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new Bt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new wi,this.combine=ah,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}},Nd=new Qt,Wi=new Vn,bo=new dn,Od=new O,So=new O,wo=new O,To=new O,Hc=new O,Eo=new O,Ud=new O,Ao=new O,en=class extends un{constructor(t=new tn,e=new jo){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){let e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){let s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(t,e){let n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,o=n.morphTargetsRelative;e.fromBufferAttribute(s,t);let a=this.morphTargetInfluences;if(r&&a){Eo.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=a[l],u=r[l];h!==0&&(Hc.fromBufferAttribute(u,t),o?Eo.addScaledVector(Hc,h):Eo.addScaledVector(Hc.sub(e),h))}e.add(Eo)}return e}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),bo.copy(n.boundingSphere),bo.applyMatrix4(r),Wi.copy(t.ray).recast(t.near),!(bo.containsPoint(Wi.origin)===!1&&(Wi.intersectSphere(bo,Od)===null||Wi.origin.distanceToSquared(Od)>(t.far-t.near)**2))&&(Nd.copy(r).invert(),Wi.copy(t.ray).applyMatrix4(Nd),!(n.boundingBox!==null&&Wi.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(t,e,Wi)))}_computeIntersections(t,e,n){let s,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,d=r.groups,f=r.drawRange;if(a!==null)if(Array.isArray(o))for(let m=0,x=d.length;m<x;m++){let p=d[m],g=o[p.materialIndex],S=Math.max(p.start,f.start),w=Math.min(a.count,Math.min(p.start+p.count,f.start+f.count));for(let b=S,C=w;b<C;b+=3){let A=a.getX(b),_=a.getX(b+1),T=a.getX(b+2);s=Co(this,g,t,n,c,h,u,A,_,T),s&&(s.faceIndex=Math.floor(b/3),s.face.materialIndex=p.materialIndex,e.push(s))}}else{let m=Math.max(0,f.start),x=Math.min(a.count,f.start+f.count);for(let p=m,g=x;p<g;p+=3){let S=a.getX(p),w=a.getX(p+1),b=a.getX(p+2);s=Co(this,o,t,n,c,h,u,S,w,b),s&&(s.faceIndex=Math.floor(p/3),e.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let m=0,x=d.length;m<x;m++){let p=d[m],g=o[p.materialIndex],S=Math.max(p.start,f.start),w=Math.min(l.count,Math.min(p.start+p.count,f.start+f.count));for(let b=S,C=w;b<C;b+=3){let A=b,_=b+1,T=b+2;s=Co(this,g,t,n,c,h,u,A,_,T),s&&(s.faceIndex=Math.floor(b/3),s.face.materialIndex=p.materialIndex,e.push(s))}}else{let m=Math.max(0,f.start),x=Math.min(l.count,f.start+f.count);for(let p=m,g=x;p<g;p+=3){let S=p,w=p+1,b=p+2;s=Co(this,o,t,n,c,h,u,S,w,b),s&&(s.faceIndex=Math.floor(p/3),e.push(s))}}}};function y0(i,t,e,n,s,r,o,a){let l;if(t.side===Be?l=n.intersectTriangle(o,r,s,!0,a):l=n.intersectTriangle(s,r,o,t.side===Di,a),l===null)return null;Ao.copy(a),Ao.applyMatrix4(i.matrixWorld);let c=e.ray.origin.distanceTo(Ao);return c<e.near||c>e.far?null:{distance:c,point:Ao.clone(),object:i}}function Co(i,t,e,n,s,r,o,a,l,c){i.getVertexPosition(a,So),i.getVertexPosition(l,wo),i.getVertexPosition(c,To);let h=y0(i,t,e,n,So,wo,To,Ud);if(h){let u=new O;Si.getBarycoord(Ud,So,wo,To,u),s&&(h.uv=Si.getInterpolatedAttribute(s,a,l,c,u,new Dt)),r&&(h.uv1=Si.getInterpolatedAttribute(r,a,l,c,u,new Dt)),o&&(h.normal=Si.getInterpolatedAttribute(o,a,l,c,u,new O),h.normal.dot(n.direction)>0&&h.normal.multiplyScalar(-1));let d={a,b:l,c,normal:new O,materialIndex:0};Si.getNormal(So,wo,To,d.normal),h.face=d,h.barycoord=u}return h}var Ei=class extends Qe{constructor(t=null,e=1,n=1,s,r,o,a,l,c=ve,h=ve,u,d){super(null,o,a,l,c,h,s,r,u,d),this.isDataTexture=!0,this.image={data:t,width:e,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var Xi=new dn,M0=new Dt(.5,.5),Ro=new O,qi=class{constructor(t=new qe,e=new qe,n=new qe,s=new qe,r=new qe,o=new qe){this.planes=[t,e,n,s,r,o]}set(t,e,n,s,r,o){let a=this.planes;return a[0].copy(t),a[1].copy(e),a[2].copy(n),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(t){let e=this.planes;for(let n=0;n<6;n++)e[n].copy(t.planes[n]);return this}setFromProjectionMatrix(t,e=Sn,n=!1){let s=this.planes,r=t.elements,o=r[0],a=r[1],l=r[2],c=r[3],h=r[4],u=r[5],d=r[6],f=r[7],m=r[8],x=r[9],p=r[10],g=r[11],S=r[12],w=r[13],b=r[14],C=r[15];if(s[0].setComponents(c-o,f-h,g-m,C-S).normalize(),s[1].setComponents(c+o,f+h,g+m,C+S).normalize(),s[2].setComponents(c+a,f+u,g+x,C+w).normalize(),s[3].setComponents(c-a,f-u,g-x,C-w).normalize(),n)s[4].setComponents(l,d,p,b).normalize(),s[5].setComponents(c-l,f-d,g-p,C-b).normalize();else if(s[4].setComponents(c-l,f-d,g-p,C-b).normalize(),e===Sn)s[5].setComponents(c+l,f+d,g+p,C+b).normalize();else if(e===ur)s[5].setComponents(l,d,p,b).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),Xi.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{let e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),Xi.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(Xi)}intersectsSprite(t){Xi.center.set(0,0,0);let e=M0.distanceTo(t.center);return Xi.radius=.7071067811865476+e,Xi.applyMatrix4(t.matrixWorld),this.intersectsSphere(Xi)}intersectsSphere(t){let e=this.planes,n=t.center,s=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(t){let e=this.planes;for(let n=0;n<6;n++){let s=e[n];if(Ro.x=s.normal.x>0?t.max.x:t.min.x,Ro.y=s.normal.y>0?t.max.y:t.min.y,Ro.z=s.normal.z>0?t.max.z:t.min.z,s.distanceToPoint(Ro)<0)return!1}return!0}containsPoint(t){let e=this.planes;for(let n=0;n<6;n++)if(e[n].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},Fd=new Qt,Qo=class i{constructor(){this.coordinateSystem=Sn,this._frustums=[],this._count=0}setFromArrayCamera(t){let e=t.cameras,n=this._frustums;for(let s=0;s<e.length;s++){let r=e[s];Fd.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),n[s]===void 0&&(n[s]=new qi),n[s].setFromProjectionMatrix(Fd,r.coordinateSystem,r.reversedDepth)}return this._count=e.length,this}getFrustum(t){return this._frustums[t]}intersectsObject(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsObject(t))return!0;return!1}intersectsSprite(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsSprite(t))return!0;return!1}intersectsSphere(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsSphere(t))return!0;return!1}intersectsBox(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsBox(t))return!0;return!1}containsPoint(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].containsPoint(t))return!0;return!1}copy(t){this.coordinateSystem=t.coordinateSystem;let e=this._frustums,n=t._frustums;for(let s=0;s<t._count;s++)e[s]===void 0&&(e[s]=new qi),e[s].copy(n[s]);return this._count=t._count,this}clone(){return new i().copy(this)}};var ta=class extends Ti{constructor(t){super(),this.isPointsMaterial=!0,this.type="PointsMaterial",this.color=new Bt(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.alphaMap=t.alphaMap,this.size=t.size,this.sizeAttenuation=t.sizeAttenuation,this.fog=t.fog,this}},Bd=new Qt,Yc=new Vn,Po=new dn,Io=new O,_r=class extends un{constructor(t=new tn,e=new ta){super(),this.isPoints=!0,this.type="Points",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let n=this.geometry,s=this.matrixWorld,r=t.params.Points.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),Po.copy(n.boundingSphere),Po.applyMatrix4(s),Po.radius+=r,t.ray.intersectsSphere(Po)===!1)return;Bd.copy(s).invert(),Yc.copy(t.ray).applyMatrix4(Bd);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=n.index,u=n.attributes.position;if(c!==null){let d=Math.max(0,o.start),f=Math.min(c.count,o.start+o.count);for(let m=d,x=f;m<x;m++){let p=c.getX(m);Io.fromBufferAttribute(u,p),kd(Io,p,l,s,t,e,this)}}else{let d=Math.max(0,o.start),f=Math.min(u.count,o.start+o.count);for(let m=d,x=f;m<x;m++)Io.fromBufferAttribute(u,m),kd(Io,m,l,s,t,e,this)}}updateMorphTargets(){let e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){let s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function kd(i,t,e,n,s,r,o){let a=Yc.distanceSqToPoint(i);if(a<e){let l=new O;Yc.closestPointToPoint(i,l),l.applyMatrix4(n);let c=s.ray.origin.distanceTo(l);if(c<s.near||c>s.far)return;r.push({distance:c,distanceToRay:Math.sqrt(a),point:l,index:t,face:null,faceIndex:null,barycoord:null,object:o})}}var xr=class extends Qe{constructor(t=[],e=Ji,n,s,r,o,a,l,c,h){super(t,e,n,s,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}};var li=class extends Qe{constructor(t,e,n=Ln,s,r,o,a=ve,l=ve,c,h=ai,u=1){if(h!==ai&&h!==hi)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let d={width:t,height:e,depth:u};super(d,s,r,o,a,l,h,n,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.source=new bs(Object.assign({},t.image)),this.compareFunction=t.compareFunction,this}toJSON(t){let e=super.toJSON(t);return e.compareFunction=this.compareFunction,e}},vr=class extends li{constructor(t,e=Ln,n=Ji,s,r,o=ve,a=ve,l,c=ai){let h={width:t,height:t,depth:1},u=[h,h,h,h,h,h];super(t,t,e,n,s,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(t){this.image=t}},yr=class extends Qe{constructor(t=null){super(),this.sourceTexture=t,this.isExternalTexture=!0}copy(t){return super.copy(t),this.sourceTexture=t.sourceTexture,this}},Ts=class i extends tn{constructor(t=1,e=1,n=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:n,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],h=[],u=[],d=0,f=0;m("z","y","x",-1,-1,n,e,t,o,r,0),m("z","y","x",1,-1,n,e,-t,o,r,1),m("x","z","y",1,1,t,n,e,s,o,2),m("x","z","y",1,-1,t,n,-e,s,o,3),m("x","y","z",1,-1,t,e,n,s,r,4),m("x","y","z",-1,-1,t,e,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new Ye(c,3)),this.setAttribute("normal",new Ye(h,3)),this.setAttribute("uv",new Ye(u,2));function m(x,p,g,S,w,b,C,A,_,T,F){let L=b/_,N=C/T,z=b/2,Y=C/2,I=A/2,X=_+1,$=T+1,V=0,it=0,W=new O;for(let tt=0;tt<$;tt++){let et=tt*N-Y;for(let Mt=0;Mt<X;Mt++){let It=Mt*L-z;W[x]=It*S,W[p]=et*w,W[g]=I,c.push(W.x,W.y,W.z),W[x]=0,W[p]=0,W[g]=A>0?1:-1,h.push(W.x,W.y,W.z),u.push(Mt/_),u.push(1-tt/T),V+=1}}for(let tt=0;tt<T;tt++)for(let et=0;et<_;et++){let Mt=d+et+X*tt,It=d+et+X*(tt+1),J=d+(et+1)+X*(tt+1),pt=d+(et+1)+X*tt;l.push(Mt,It,pt),l.push(It,J,pt),it+=6}a.addGroup(f,it,F),f+=it,d+=V}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}};var Mr=class i extends tn{constructor(t=1,e=32,n=0,s=Math.PI*2){super(),this.type="CircleGeometry",this.parameters={radius:t,segments:e,thetaStart:n,thetaLength:s},e=Math.max(3,e);let r=[],o=[],a=[],l=[],c=new O,h=new Dt;o.push(0,0,0),a.push(0,0,1),l.push(.5,.5);for(let u=0,d=3;u<=e;u++,d+=3){let f=n+u/e*s;c.x=t*Math.cos(f),c.y=t*Math.sin(f),o.push(c.x,c.y,c.z),a.push(0,0,1),h.x=(o[d]/t+1)/2,h.y=(o[d+1]/t+1)/2,l.push(h.x,h.y)}for(let u=1;u<=e;u++)r.push(u,u+1,0);this.setIndex(r),this.setAttribute("position",new Ye(o,3)),this.setAttribute("normal",new Ye(a,3)),this.setAttribute("uv",new Ye(l,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.radius,t.segments,t.thetaStart,t.thetaLength)}};function b0(i,t,e=2){let n=t&&t.length,s=n?t[0]*e:i.length,r=Ff(i,0,s,e,!0),o=[];if(!r||r.next===r.prev)return o;let a,l,c;if(n&&(r=A0(i,t,r,e)),i.length>80*e){a=i[0],l=i[1];let h=a,u=l;for(let d=e;d<s;d+=e){let f=i[d],m=i[d+1];f<a&&(a=f),m<l&&(l=m),f>h&&(h=f),m>u&&(u=m)}c=Math.max(h-a,u-l),c=c!==0?32767/c:0}return br(r,o,e,a,l,c,0),o}function Ff(i,t,e,n,s){let r;if(s===B0(i,t,e,n)>0)for(let o=t;o<e;o+=n)r=zd(o/n|0,i[o],i[o+1],r);else for(let o=e-n;o>=t;o-=n)r=zd(o/n|0,i[o],i[o+1],r);return r&&Es(r,r.next)&&(wr(r),r=r.next),r}function $i(i,t){if(!i)return i;t||(t=i);let e=i,n;do if(n=!1,!e.steiner&&(Es(e,e.next)||ge(e.prev,e,e.next)===0)){if(wr(e),e=t=e.prev,e===e.next)break;n=!0}else e=e.next;while(n||e!==t);return t}function br(i,t,e,n,s,r,o){if(!i)return;!o&&r&&L0(i,n,s,r);let a=i;for(;i.prev!==i.next;){let l=i.prev,c=i.next;if(r?w0(i,n,s,r):S0(i)){t.push(l.i,i.i,c.i),wr(i),i=c.next,a=c.next;continue}if(i=c,i===a){o?o===1?(i=T0($i(i),t),br(i,t,e,n,s,r,2)):o===2&&E0(i,t,e,n,s,r):br($i(i),t,e,n,s,r,1);break}}}function S0(i){let t=i.prev,e=i,n=i.next;if(ge(t,e,n)>=0)return!1;let s=t.x,r=e.x,o=n.x,a=t.y,l=e.y,c=n.y,h=Math.min(s,r,o),u=Math.min(a,l,c),d=Math.max(s,r,o),f=Math.max(a,l,c),m=n.next;for(;m!==t;){if(m.x>=h&&m.x<=d&&m.y>=u&&m.y<=f&&sr(s,a,r,l,o,c,m.x,m.y)&&ge(m.prev,m,m.next)>=0)return!1;m=m.next}return!0}function w0(i,t,e,n){let s=i.prev,r=i,o=i.next;if(ge(s,r,o)>=0)return!1;let a=s.x,l=r.x,c=o.x,h=s.y,u=r.y,d=o.y,f=Math.min(a,l,c),m=Math.min(h,u,d),x=Math.max(a,l,c),p=Math.max(h,u,d),g=Zc(f,m,t,e,n),S=Zc(x,p,t,e,n),w=i.prevZ,b=i.nextZ;for(;w&&w.z>=g&&b&&b.z<=S;){if(w.x>=f&&w.x<=x&&w.y>=m&&w.y<=p&&w!==s&&w!==o&&sr(a,h,l,u,c,d,w.x,w.y)&&ge(w.prev,w,w.next)>=0||(w=w.prevZ,b.x>=f&&b.x<=x&&b.y>=m&&b.y<=p&&b!==s&&b!==o&&sr(a,h,l,u,c,d,b.x,b.y)&&ge(b.prev,b,b.next)>=0))return!1;b=b.nextZ}for(;w&&w.z>=g;){if(w.x>=f&&w.x<=x&&w.y>=m&&w.y<=p&&w!==s&&w!==o&&sr(a,h,l,u,c,d,w.x,w.y)&&ge(w.prev,w,w.next)>=0)return!1;w=w.prevZ}for(;b&&b.z<=S;){if(b.x>=f&&b.x<=x&&b.y>=m&&b.y<=p&&b!==s&&b!==o&&sr(a,h,l,u,c,d,b.x,b.y)&&ge(b.prev,b,b.next)>=0)return!1;b=b.nextZ}return!0}function T0(i,t){let e=i;do{let n=e.prev,s=e.next.next;!Es(n,s)&&kf(n,e,e.next,s)&&Sr(n,s)&&Sr(s,n)&&(t.push(n.i,e.i,s.i),wr(e),wr(e.next),e=i=s),e=e.next}while(e!==i);return $i(e)}function E0(i,t,e,n,s,r){let o=i;do{let a=o.next.next;for(;a!==o.prev;){if(o.i!==a.i&&O0(o,a)){let l=zf(o,a);o=$i(o,o.next),l=$i(l,l.next),br(o,t,e,n,s,r,0),br(l,t,e,n,s,r,0);return}a=a.next}o=o.next}while(o!==i)}function A0(i,t,e,n){let s=[];for(let r=0,o=t.length;r<o;r++){let a=t[r]*n,l=r<o-1?t[r+1]*n:i.length,c=Ff(i,a,l,n,!1);c===c.next&&(c.steiner=!0),s.push(N0(c))}s.sort(C0);for(let r=0;r<s.length;r++)e=R0(s[r],e);return e}function C0(i,t){let e=i.x-t.x;if(e===0&&(e=i.y-t.y,e===0)){let n=(i.next.y-i.y)/(i.next.x-i.x),s=(t.next.y-t.y)/(t.next.x-t.x);e=n-s}return e}function R0(i,t){let e=P0(i,t);if(!e)return t;let n=zf(e,i);return $i(n,n.next),$i(e,e.next)}function P0(i,t){let e=t,n=i.x,s=i.y,r=-1/0,o;if(Es(i,e))return e;do{if(Es(i,e.next))return e.next;if(s<=e.y&&s>=e.next.y&&e.next.y!==e.y){let u=e.x+(s-e.y)*(e.next.x-e.x)/(e.next.y-e.y);if(u<=n&&u>r&&(r=u,o=e.x<e.next.x?e:e.next,u===n))return o}e=e.next}while(e!==t);if(!o)return null;let a=o,l=o.x,c=o.y,h=1/0;e=o;do{if(n>=e.x&&e.x>=l&&n!==e.x&&Bf(s<c?n:r,s,l,c,s<c?r:n,s,e.x,e.y)){let u=Math.abs(s-e.y)/(n-e.x);Sr(e,i)&&(u<h||u===h&&(e.x>o.x||e.x===o.x&&I0(o,e)))&&(o=e,h=u)}e=e.next}while(e!==a);return o}function I0(i,t){return ge(i.prev,i,t.prev)<0&&ge(t.next,i,i.next)<0}function L0(i,t,e,n){let s=i;do s.z===0&&(s.z=Zc(s.x,s.y,t,e,n)),s.prevZ=s.prev,s.nextZ=s.next,s=s.next;while(s!==i);s.prevZ.nextZ=null,s.prevZ=null,D0(s)}function D0(i){let t,e=1;do{let n=i,s;i=null;let r=null;for(t=0;n;){t++;let o=n,a=0;for(let c=0;c<e&&(a++,o=o.nextZ,!!o);c++);let l=e;for(;a>0||l>0&&o;)a!==0&&(l===0||!o||n.z<=o.z)?(s=n,n=n.nextZ,a--):(s=o,o=o.nextZ,l--),r?r.nextZ=s:i=s,s.prevZ=r,r=s;n=o}r.nextZ=null,e*=2}while(t>1);return i}function Zc(i,t,e,n,s){return i=(i-e)*s|0,t=(t-n)*s|0,i=(i|i<<8)&16711935,i=(i|i<<4)&252645135,i=(i|i<<2)&858993459,i=(i|i<<1)&1431655765,t=(t|t<<8)&16711935,t=(t|t<<4)&252645135,t=(t|t<<2)&858993459,t=(t|t<<1)&1431655765,i|t<<1}function N0(i){let t=i,e=i;do(t.x<e.x||t.x===e.x&&t.y<e.y)&&(e=t),t=t.next;while(t!==i);return e}function Bf(i,t,e,n,s,r,o,a){return(s-o)*(t-a)>=(i-o)*(r-a)&&(i-o)*(n-a)>=(e-o)*(t-a)&&(e-o)*(r-a)>=(s-o)*(n-a)}function sr(i,t,e,n,s,r,o,a){return!(i===o&&t===a)&&Bf(i,t,e,n,s,r,o,a)}function O0(i,t){return i.next.i!==t.i&&i.prev.i!==t.i&&!U0(i,t)&&(Sr(i,t)&&Sr(t,i)&&F0(i,t)&&(ge(i.prev,i,t.prev)||ge(i,t.prev,t))||Es(i,t)&&ge(i.prev,i,i.next)>0&&ge(t.prev,t,t.next)>0)}function ge(i,t,e){return(t.y-i.y)*(e.x-t.x)-(t.x-i.x)*(e.y-t.y)}function Es(i,t){return i.x===t.x&&i.y===t.y}function kf(i,t,e,n){let s=Do(ge(i,t,e)),r=Do(ge(i,t,n)),o=Do(ge(e,n,i)),a=Do(ge(e,n,t));return!!(s!==r&&o!==a||s===0&&Lo(i,e,t)||r===0&&Lo(i,n,t)||o===0&&Lo(e,i,n)||a===0&&Lo(e,t,n))}function Lo(i,t,e){return t.x<=Math.max(i.x,e.x)&&t.x>=Math.min(i.x,e.x)&&t.y<=Math.max(i.y,e.y)&&t.y>=Math.min(i.y,e.y)}function Do(i){return i>0?1:i<0?-1:0}function U0(i,t){let e=i;do{if(e.i!==i.i&&e.next.i!==i.i&&e.i!==t.i&&e.next.i!==t.i&&kf(e,e.next,i,t))return!0;e=e.next}while(e!==i);return!1}function Sr(i,t){return ge(i.prev,i,i.next)<0?ge(i,t,i.next)>=0&&ge(i,i.prev,t)>=0:ge(i,t,i.prev)<0||ge(i,i.next,t)<0}function F0(i,t){let e=i,n=!1,s=(i.x+t.x)/2,r=(i.y+t.y)/2;do e.y>r!=e.next.y>r&&e.next.y!==e.y&&s<(e.next.x-e.x)*(r-e.y)/(e.next.y-e.y)+e.x&&(n=!n),e=e.next;while(e!==i);return n}function zf(i,t){let e=Jc(i.i,i.x,i.y),n=Jc(t.i,t.x,t.y),s=i.next,r=t.prev;return i.next=t,t.prev=i,e.next=s,s.prev=e,n.next=e,e.prev=n,r.next=n,n.prev=r,n}function zd(i,t,e,n){let s=Jc(i,t,e);return n?(s.next=n.next,s.prev=n,n.next.prev=s,n.next=s):(s.prev=s,s.next=s),s}function wr(i){i.next.prev=i.prev,i.prev.next=i.next,i.prevZ&&(i.prevZ.nextZ=i.nextZ),i.nextZ&&(i.nextZ.prevZ=i.prevZ)}function Jc(i,t,e){return{i,x:t,y:e,prev:null,next:null,z:0,prevZ:null,nextZ:null,steiner:!1}}function B0(i,t,e,n){let s=0;for(let r=t,o=e-n;r<e;r+=n)s+=(i[o]-i[r])*(i[r+1]+i[o+1]),o=r;return s}var Kc=class{static triangulate(t,e,n=2){return b0(t,e,n)}},Ai=class i{static area(t){let e=t.length,n=0;for(let s=e-1,r=0;r<e;s=r++)n+=t[s].x*t[r].y-t[r].x*t[s].y;return n*.5}static isClockWise(t){return i.area(t)<0}static triangulateShape(t,e){let n=[],s=[],r=[];Gd(t),Vd(n,t);let o=t.length;e.forEach(Gd);for(let l=0;l<e.length;l++)s.push(o),o+=e[l].length,Vd(n,e[l]);let a=Kc.triangulate(n,s);for(let l=0;l<a.length;l+=3)r.push(a.slice(l,l+3));return r}};function Gd(i){let t=i.length;t>2&&i[t-1].equals(i[0])&&i.pop()}function Vd(i,t){for(let e=0;e<t.length;e++)i.push(t[e].x),i.push(t[e].y)}var Tr=class i extends tn{constructor(t=1,e=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:n,heightSegments:s};let r=t/2,o=e/2,a=Math.floor(n),l=Math.floor(s),c=a+1,h=l+1,u=t/a,d=e/l,f=[],m=[],x=[],p=[];for(let g=0;g<h;g++){let S=g*d-o;for(let w=0;w<c;w++){let b=w*u-r;m.push(b,-S,0),x.push(0,0,1),p.push(w/a),p.push(1-g/l)}}for(let g=0;g<l;g++)for(let S=0;S<a;S++){let w=S+c*g,b=S+c*(g+1),C=S+1+c*(g+1),A=S+1+c*g;f.push(w,b,A),f.push(b,C,A)}this.setIndex(f),this.setAttribute("position",new Ye(m,3)),this.setAttribute("normal",new Ye(x,3)),this.setAttribute("uv",new Ye(p,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.width,t.height,t.widthSegments,t.heightSegments)}};function ji(i){let t={};for(let e in i){t[e]={};for(let n in i[e]){let s=i[e][n];if(Hd(s))s.isRenderTargetTexture?(Nt("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][n]=null):t[e][n]=s.clone();else if(Array.isArray(s))if(Hd(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();t[e][n]=r}else t[e][n]=s.slice();else t[e][n]=s}}return t}function We(i){let t={};for(let e=0;e<i.length;e++){let n=ji(i[e]);for(let s in n)t[s]=n[s]}return t}function Hd(i){return i&&(i.isColor||i.isMatrix3||i.isMatrix4||i.isVector2||i.isVector3||i.isVector4||i.isTexture||i.isQuaternion)}function k0(i){let t=[];for(let e=0;e<i.length;e++)t.push(i[e].clone());return t}function Lh(i){let t=i.getRenderTarget();return t===null?i.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:Kt.workingColorSpace}var Gf={clone:ji,merge:We},z0=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,G0=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,Hn=class extends Ti{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=z0,this.fragmentShader=G0,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=ji(t.uniforms),this.uniformsGroups=k0(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this.defaultAttributeValues=Object.assign({},t.defaultAttributeValues),this.index0AttributeName=t.index0AttributeName,this.uniformsNeedUpdate=t.uniformsNeedUpdate,this}toJSON(t){let e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?e.uniforms[s]={type:"t",value:o.toJSON(t).uuid}:o&&o.isColor?e.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?e.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?e.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?e.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?e.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?e.uniforms[s]={type:"m4",value:o.toArray()}:e.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;let n={};for(let s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(e.extensions=n),e}fromJSON(t,e){if(super.fromJSON(t,e),t.uniforms!==void 0)for(let n in t.uniforms){let s=t.uniforms[n];switch(this.uniforms[n]={},s.type){case"t":this.uniforms[n].value=e[s.value]||null;break;case"c":this.uniforms[n].value=new Bt().setHex(s.value);break;case"v2":this.uniforms[n].value=new Dt().fromArray(s.value);break;case"v3":this.uniforms[n].value=new O().fromArray(s.value);break;case"v4":this.uniforms[n].value=new _e().fromArray(s.value);break;case"m3":this.uniforms[n].value=new Ft().fromArray(s.value);break;case"m4":this.uniforms[n].value=new Qt().fromArray(s.value);break;default:this.uniforms[n].value=s.value}}if(t.defines!==void 0&&(this.defines=t.defines),t.vertexShader!==void 0&&(this.vertexShader=t.vertexShader),t.fragmentShader!==void 0&&(this.fragmentShader=t.fragmentShader),t.glslVersion!==void 0&&(this.glslVersion=t.glslVersion),t.extensions!==void 0)for(let n in t.extensions)this.extensions[n]=t.extensions[n];return t.lights!==void 0&&(this.lights=t.lights),t.clipping!==void 0&&(this.clipping=t.clipping),this}},Wn=class extends Hn{constructor(t){super(t),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var ea=class extends Ti{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=Mf,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}},na=class extends Ti{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}};function ms(i,t){return!i||i.constructor===t?i:typeof t.BYTES_PER_ELEMENT=="number"?new t(i):Array.prototype.slice.call(i)}function No(i){return i!==void 0&&i.inTangents!==void 0&&i.outTangents!==void 0}var Ci=class{constructor(t,e,n,s){this.parameterPositions=t,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new e.constructor(n),this.sampleValues=e,this.valueSize=n,this.settings=null,this.DefaultSettings_={}}evaluate(t){let e=this.parameterPositions,n=this._cachedIndex,s=e[n],r=e[n-1];n:{t:{let o;e:{i:if(!(t<s)){for(let a=n+2;;){if(s===void 0){if(t<r)break i;return n=e.length,this._cachedIndex=n,this.copySampleValue_(n-1)}if(n===a)break;if(r=s,s=e[++n],t<s)break t}o=e.length;break e}if(!(t>=r)){let a=e[1];t<a&&(n=2,r=a);for(let l=n-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===l)break;if(s=r,r=e[--n-1],t>=r)break t}o=n,n=0;break e}break n}for(;n<o;){let a=n+o>>>1;t<e[a]?o=a:n=a+1}if(s=e[n],r=e[n-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return n=e.length,this._cachedIndex=n,this.copySampleValue_(n-1)}this._cachedIndex=n,this.intervalChanged_(n,r,s)}return this.interpolate_(n,r,t,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(t){let e=this.resultBuffer,n=this.sampleValues,s=this.valueSize,r=t*s;for(let o=0;o!==s;++o)e[o]=n[r+o];return e}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},ia=class extends Ci{constructor(t,e,n,s){super(t,e,n,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:Xc,endingEnd:Xc}}intervalChanged_(t,e,n){let s=this.parameterPositions,r=t-2,o=t+1,a=s[r],l=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case qc:r=t,a=2*e-n;break;case $c:r=s.length-2,a=e+s[r]-s[r+1];break;default:r=t,a=n}if(l===void 0)switch(this.getSettings_().endingEnd){case qc:o=t,l=2*n-e;break;case $c:o=1,l=n+s[1]-s[0];break;default:o=t-1,l=e}let c=(n-e)*.5,h=this.valueSize;this._weightPrev=c/(e-a),this._weightNext=c/(l-n),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=this._offsetPrev,u=this._offsetNext,d=this._weightPrev,f=this._weightNext,m=(n-e)/(s-e),x=m*m,p=x*m,g=-d*p+2*d*x-d*m,S=(1+d)*p+(-1.5-2*d)*x+(-.5+d)*m+1,w=(-1-f)*p+(1.5+f)*x+.5*m,b=f*p-f*x;for(let C=0;C!==a;++C)r[C]=g*o[h+C]+S*o[c+C]+w*o[l+C]+b*o[u+C];return r}},sa=class extends Ci{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=(n-e)/(s-e),u=1-h;for(let d=0;d!==a;++d)r[d]=o[c+d]*u+o[l+d]*h;return r}},ra=class extends Ci{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t){return this.copySampleValue_(t-1)}},oa=class extends Ci{interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let m=(n-e)/(s-e),x=1-m;for(let p=0;p!==a;++p)r[p]=o[c+p]*x+o[l+p]*m;return r}let d=a*2,f=t-1;for(let m=0;m!==a;++m){let x=o[c+m],p=o[l+m],g=f*d+m*2,S=u[g],w=u[g+1],b=t*d+m*2,C=h[b],A=h[b+1],_=H0(n,e,S,C,s);r[m]=Vf(_,x,w,A,p)}return r}};function Vf(i,t,e,n,s){let r=1-i;return r*r*r*t+3*r*r*i*e+3*r*i*i*n+i*i*i*s}function V0(i,t,e,n,s){let r=1-i;return 3*r*r*(e-t)+6*r*i*(n-e)+3*i*i*(s-n)}function H0(i,t,e,n,s){let r=(i-t)/(s-t);for(let o=0;o<8;o++){let a=Vf(r,t,e,n,s)-i;if(Math.abs(a)<1e-10)break;let l=V0(r,t,e,n,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var fn=class{constructor(t,e,n,s){if(t===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(e===void 0||e.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+t);this.name=t,this.times=ms(e,this.TimeBufferType),this.values=ms(n,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(t){let e=t.constructor,n;if(e.toJSON!==this.toJSON)n=e.toJSON(t);else{n={name:t.name,times:ms(t.times,Array),values:ms(t.values,Array)};let s=t.getInterpolation();s!==t.DefaultInterpolation&&(n.interpolation=s),No(t.settings)&&(n.settings={inTangents:ms(t.settings.inTangents,Array),outTangents:ms(t.settings.outTangents,Array)})}return n.type=t.ValueTypeName,n}InterpolantFactoryMethodDiscrete(t){return new ra(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodLinear(t){return new sa(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodSmooth(t){return new ia(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodBezier(t){let e=new oa(this.times,this.values,this.getValueSize(),t);return this.settings&&(e.inTangents=this.settings.inTangents,e.outTangents=this.settings.outTangents),e}setInterpolation(t){let e;switch(t){case lr:e=this.InterpolantFactoryMethodDiscrete;break;case Yo:e=this.InterpolantFactoryMethodLinear;break;case Fo:e=this.InterpolantFactoryMethodSmooth;break;case Wc:e=this.InterpolantFactoryMethodBezier;break}if(e===void 0){let n="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(t!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(n);return Nt("KeyframeTrack:",n),this}return this.createInterpolant=e,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return lr;case this.InterpolantFactoryMethodLinear:return Yo;case this.InterpolantFactoryMethodSmooth:return Fo;case this.InterpolantFactoryMethodBezier:return Wc}}getValueSize(){return this.values.length/this.times.length}shift(t){if(t!==0){let e=this.times;for(let n=0,s=e.length;n!==s;++n)e[n]+=t;No(this.settings)&&(Wd(this.settings.inTangents,t),Wd(this.settings.outTangents,t))}return this}scale(t){if(t!==1){let e=this.times;for(let n=0,s=e.length;n!==s;++n)e[n]*=t;No(this.settings)&&(Xd(this.settings.inTangents,t),Xd(this.settings.outTangents,t))}return this}trim(t,e){let n=this.times,s=n.length,r=0,o=s-1;for(;r!==s&&n[r]<t;)++r;for(;o!==-1&&n[o]>e;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=n.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let t=!0,e=this.getValueSize();e-Math.floor(e)!==0&&(Ot("KeyframeTrack: Invalid value size in track.",this),t=!1);let n=this.times,s=this.values,r=n.length;r===0&&(Ot("KeyframeTrack: Track is empty.",this),t=!1);let o=null;for(let a=0;a!==r;a++){let l=n[a];if(typeof l=="number"&&isNaN(l)){Ot("KeyframeTrack: Time is not a valid number.",this,a,l),t=!1;break}if(o!==null&&o>l){Ot("KeyframeTrack: Out of order keys.",this,a,l,o),t=!1;break}o=l}if(s!==void 0&&Vg(s))for(let a=0,l=s.length;a!==l;++a){let c=s[a];if(isNaN(c)){Ot("KeyframeTrack: Value is not a valid number.",this,a,c),t=!1;break}}return t}optimize(){let t=this.times.slice(),e=this.values.slice(),n=this.getValueSize(),s=this.getInterpolation()===Fo,r=t.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=t[a],h=t[a+1];if(c!==h&&(a!==1||c!==t[0]))if(s)l=!0;else{let u=a*n,d=u-n,f=u+n;for(let m=0;m!==n;++m){let x=e[u+m];if(x!==e[d+m]||x!==e[f+m]){l=!0;break}}}if(l){if(a!==o){t[o]=t[a];let u=a*n,d=o*n;for(let f=0;f!==n;++f)e[d+f]=e[u+f]}++o}}if(r>0){t[o]=t[r];for(let a=r*n,l=o*n,c=0;c!==n;++c)e[l+c]=e[a+c];++o}return o!==t.length?(this.times=t.slice(0,o),this.values=e.slice(0,o*n)):(this.times=t,this.values=e),this}clone(){let t=this.times.slice(),e=this.values.slice(),n=this.constructor,s=new n(this.name,t,e);return s.createInterpolant=this.createInterpolant,No(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function Wd(i,t){for(let e=0,n=i.length;e!==n;e+=2)i[e]+=t}function Xd(i,t){for(let e=0,n=i.length;e!==n;e+=2)i[e]*=t}fn.prototype.ValueTypeName="";fn.prototype.TimeBufferType=Float32Array;fn.prototype.ValueBufferType=Float32Array;fn.prototype.DefaultInterpolation=Yo;var Ri=class extends fn{constructor(t,e,n){super(t,e,n)}};Ri.prototype.ValueTypeName="bool";Ri.prototype.ValueBufferType=Array;Ri.prototype.DefaultInterpolation=lr;Ri.prototype.InterpolantFactoryMethodLinear=void 0;Ri.prototype.InterpolantFactoryMethodSmooth=void 0;var aa=class extends fn{constructor(t,e,n,s){super(t,e,n,s)}};aa.prototype.ValueTypeName="color";var la=class extends fn{constructor(t,e,n,s){super(t,e,n,s)}};la.prototype.ValueTypeName="number";var ca=class extends Ci{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(n-e)/(s-e),c=t*a;for(let h=c+a;c!==h;c+=4)cn.slerpFlat(r,0,o,c-a,o,c,l);return r}},Er=class extends fn{constructor(t,e,n,s){super(t,e,n,s)}InterpolantFactoryMethodLinear(t){return new ca(this.times,this.values,this.getValueSize(),t)}};Er.prototype.ValueTypeName="quaternion";Er.prototype.InterpolantFactoryMethodSmooth=void 0;var Pi=class extends fn{constructor(t,e,n){super(t,e,n)}};Pi.prototype.ValueTypeName="string";Pi.prototype.ValueBufferType=Array;Pi.prototype.DefaultInterpolation=lr;Pi.prototype.InterpolantFactoryMethodLinear=void 0;Pi.prototype.InterpolantFactoryMethodSmooth=void 0;var ha=class extends fn{constructor(t,e,n,s){super(t,e,n,s)}};ha.prototype.ValueTypeName="vector";var ua=class{constructor(t,e,n){let s=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=t,this.onProgress=e,this.onError=n,this._abortController=null,this.itemStart=function(h){a++,r===!1&&s.onStart!==void 0&&s.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,s.onProgress!==void 0&&s.onProgress(h,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,d=c.length;u<d;u+=2){let f=c[u],m=c[u+1];if(f.global&&(f.lastIndex=0),f.test(h))return m}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},Hf=new ua,da=class{constructor(t){this.manager=t!==void 0?t:Hf,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(t,e){let n=this;return new Promise(function(s,r){n.load(t,s,e,r)})}parse(){}setCrossOrigin(t){return this.crossOrigin=t,this}setWithCredentials(t){return this.withCredentials=t,this}setPath(t){return this.path=t,this}setResourcePath(t){return this.resourcePath=t,this}setRequestHeader(t){return this.requestHeader=t,this}setPriority(t){return this.priority=t,this}setCache(t){return this.cache=t,this}abort(){return this}};da.DEFAULT_MATERIAL_NAME="__DEFAULT";var Oo=new O,Uo=new cn,kn=new O,Ar=class extends un{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new Qt,this.projectionMatrix=new Qt,this.projectionMatrixInverse=new Qt,this.coordinateSystem=Sn,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorld.decompose(Oo,Uo,kn),kn.x===1&&kn.y===1&&kn.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Oo,Uo,kn.set(1,1,1)).invert()}updateWorldMatrix(t,e,n=!1){super.updateWorldMatrix(t,e,n),this.matrixWorld.decompose(Oo,Uo,kn),kn.x===1&&kn.y===1&&kn.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Oo,Uo,kn.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},bi=new O,qd=new Dt,$d=new Dt,$e=class extends Ar{constructor(t=50,e=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){let e=.5*this.getFilmHeight()/t;this.fov=Ms*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){let t=Math.tan(or*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return Ms*2*Math.atan(Math.tan(or*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,n){bi.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(bi.x,bi.y).multiplyScalar(-t/bi.z),bi.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(bi.x,bi.y).multiplyScalar(-t/bi.z)}getViewSize(t,e){return this.getViewBounds(t,qd,$d),e.subVectors($d,qd)}setViewOffset(t,e,n,s,r,o){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=this.near,e=t*Math.tan(or*.5*this.fov)/this.zoom,n=2*e,s=this.aspect*n,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,e-=o.offsetY*n/c,s*=o.width/l,n*=o.height/c}let a=this.filmOffset;a!==0&&(r+=t*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,e,e-n,t,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}};var fa=class extends Ar{constructor(t=-1,e=1,n=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=n,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,n,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=n-t,o=n+t,a=s+e,l=s-e;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}};var gs=-90,_s=1,As=class extends un{constructor(t,e,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new $e(gs,_s,t,e);s.layers=this.layers,this.add(s);let r=new $e(gs,_s,t,e);r.layers=this.layers,this.add(r);let o=new $e(gs,_s,t,e);o.layers=this.layers,this.add(o);let a=new $e(gs,_s,t,e);a.layers=this.layers,this.add(a);let l=new $e(gs,_s,t,e);l.layers=this.layers,this.add(l);let c=new $e(gs,_s,t,e);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let t=this.coordinateSystem,e=this.children.concat(),[n,s,r,o,a,l]=e;for(let c of e)this.remove(c);if(t===Sn)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(t===ur)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(let c of e)this.add(c),c.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();let{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,h]=this.children,u=t.getRenderTarget(),d=t.getActiveCubeFace(),f=t.getActiveMipmapLevel(),m=t.xr.enabled;t.xr.enabled=!1;let x=n.texture.mipmapsAutoUpdate;n.texture.mipmapsAutoUpdate=!1;let p=!1;t.isWebGLRenderer===!0?p=t.state.buffers.depth.getReversed():p=t.reversedDepthBuffer,t.setRenderTarget(n,0,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,r),t.setRenderTarget(n,1,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,o),t.setRenderTarget(n,2,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,a),t.setRenderTarget(n,3,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,l),t.setRenderTarget(n,4,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,c),n.texture.mipmapsAutoUpdate=x,t.setRenderTarget(n,5,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,h),t.setRenderTarget(u,d,f),t.xr.enabled=m,n.texture.needsPMREMUpdate=!0}},pa=class extends $e{constructor(t=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=t,this.perCameraFrustumCulled=!1}};var Dh="\\[\\]\\.:\\/",W0=new RegExp("["+Dh+"]","g"),Nh="[^"+Dh+"]",X0="[^"+Dh.replace("\\.","")+"]",q0=/((?:WC+[\/:])*)/.source.replace("WC",Nh),$0=/(WCOD+)?/.source.replace("WCOD",X0),Y0=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",Nh),Z0=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",Nh),J0=new RegExp("^"+q0+$0+Y0+Z0+"$"),K0=["material","materials","bones","map"],jc=class{constructor(t,e,n){let s=n||ue.parseTrackName(e);this._targetGroup=t,this._bindings=t.subscribe_(e,s)}getValue(t,e){this.bind();let n=this._targetGroup.nCachedObjects_,s=this._bindings[n];s!==void 0&&s.getValue(t,e)}setValue(t,e){let n=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=n.length;s!==r;++s)n[s].setValue(t,e)}bind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,n=t.length;e!==n;++e)t[e].bind()}unbind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,n=t.length;e!==n;++e)t[e].unbind()}},ue=class i{constructor(t,e,n){this.path=e,this.parsedPath=n||i.parseTrackName(e),this.node=i.findNode(t,this.parsedPath.nodeName),this.rootNode=t,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(t,e,n){return t&&t.isAnimationObjectGroup?new i.Composite(t,e,n):new i(t,e,n)}static sanitizeNodeName(t){return t.replace(/\s/g,"_").replace(W0,"")}static parseTrackName(t){let e=J0.exec(t);if(e===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+t);let n={nodeName:e[2],objectName:e[3],objectIndex:e[4],propertyName:e[5],propertyIndex:e[6]},s=n.nodeName&&n.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=n.nodeName.substring(s+1);K0.indexOf(r)!==-1&&(n.nodeName=n.nodeName.substring(0,s),n.objectName=r)}if(n.propertyName===null||n.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+t);return n}static findNode(t,e){if(e===void 0||e===""||e==="."||e===-1||e===t.name||e===t.uuid)return t;if(t.skeleton){let n=t.skeleton.getBoneByName(e);if(n!==void 0)return n}if(t.children){let n=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===e||a.uuid===e)return a;let l=n(a.children);if(l)return l}return null},s=n(t.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(t,e){t[e]=this.targetObject[this.propertyName]}_getValue_array(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)t[e++]=n[s]}_getValue_arrayElement(t,e){t[e]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(t,e){this.resolvedProperty.toArray(t,e)}_setValue_direct(t,e){this.targetObject[this.propertyName]=t[e]}_setValue_direct_setNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++]}_setValue_array_setNeedsUpdate(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(t,e){this.resolvedProperty[this.propertyIndex]=t[e]}_setValue_arrayElement_setNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(t,e){this.resolvedProperty.fromArray(t,e)}_setValue_fromArray_setNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(t,e){this.bind(),this.getValue(t,e)}_setValue_unbound(t,e){this.bind(),this.setValue(t,e)}bind(){let t=this.node,e=this.parsedPath,n=e.objectName,s=e.propertyName,r=e.propertyIndex;if(t||(t=i.findNode(this.rootNode,e.nodeName),this.node=t),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!t){Nt("PropertyBinding: No target node found for track: "+this.path+".");return}if(n){let c=e.objectIndex;switch(n){case"materials":if(!t.material){Ot("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.materials){Ot("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}t=t.material.materials;break;case"bones":if(!t.skeleton){Ot("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}t=t.skeleton.bones;for(let h=0;h<t.length;h++)if(t[h].name===c){c=h;break}break;case"map":if("map"in t){t=t.map;break}if(!t.material){Ot("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.map){Ot("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}t=t.material.map;break;default:if(t[n]===void 0){Ot("PropertyBinding: Can not bind to objectName of node undefined.",this);return}t=t[n]}if(c!==void 0){if(t[c]===void 0){Ot("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,t);return}t=t[c]}}let o=t[s];if(o===void 0){let c=e.nodeName;Ot("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",t);return}let a=this.Versioning.None;this.targetObject=t,t.isMaterial===!0?a=this.Versioning.NeedsUpdate:t.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!t.geometry){Ot("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!t.geometry.morphAttributes){Ot("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}t.morphTargetDictionary[r]!==void 0&&(r=t.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};ue.Composite=jc;ue.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};ue.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};ue.prototype.GetterByBindingType=[ue.prototype._getValue_direct,ue.prototype._getValue_array,ue.prototype._getValue_arrayElement,ue.prototype._getValue_toArray];ue.prototype.SetterByBindingTypeAndVersioning=[[ue.prototype._setValue_direct,ue.prototype._setValue_direct_setNeedsUpdate,ue.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[ue.prototype._setValue_array,ue.prototype._setValue_array_setNeedsUpdate,ue.prototype._setValue_array_setMatrixWorldNeedsUpdate],[ue.prototype._setValue_arrayElement,ue.prototype._setValue_arrayElement_setNeedsUpdate,ue.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[ue.prototype._setValue_fromArray,ue.prototype._setValue_fromArray_setNeedsUpdate,ue.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var W1=new Float32Array(1);var Yd=new Qt,Cr=class{constructor(t,e,n=0,s=1/0){this.ray=new Vn(t,e),this.near=n,this.far=s,this.camera=null,this.layers=new Ss,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(t,e){this.ray.set(t,e)}setFromCamera(t,e){e.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(t.x,t.y,.5).unproject(e).sub(this.ray.origin).normalize(),this.camera=e):e.isOrthographicCamera?(this.ray.origin.set(t.x,t.y,e.projectionMatrix.elements[14]).unproject(e),this.ray.direction.set(0,0,-1).transformDirection(e.matrixWorld),this.camera=e):Ot("Raycaster: Unsupported camera type: "+e.type)}setFromXRController(t){return Yd.identity().extractRotation(t.matrixWorld),this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(Yd),this}intersectObject(t,e=!0,n=[]){return Qc(t,this,n,e),n.sort(Zd),n}intersectObjects(t,e=!0,n=[]){for(let s=0,r=t.length;s<r;s++)Qc(t[s],this,n,e);return n.sort(Zd),n}};function Zd(i,t){return i.distance-t.distance}function Qc(i,t,e,n){let s=!0;if(i.layers.test(t.layers)&&i.raycast(t,e)===!1&&(s=!1),s===!0&&n===!0){let r=i.children;for(let o=0,a=r.length;o<a;o++)Qc(r[o],t,e,!0)}}var Cs=class{constructor(t=1,e=0,n=0){this.radius=t,this.phi=e,this.theta=n}set(t,e,n){return this.radius=t,this.phi=e,this.theta=n,this}copy(t){return this.radius=t.radius,this.phi=t.phi,this.theta=t.theta,this}makeSafe(){return this.phi=qt(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(t){return this.setFromCartesianCoords(t.x,t.y,t.z)}setFromCartesianCoords(t,e,n){return this.radius=Math.sqrt(t*t+e*e+n*n),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(t,n),this.phi=Math.acos(qt(e/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var th=class{static{this.prototype.isMatrix2=!0}constructor(t,e,n,s){this.elements=[1,0,0,1],t!==void 0&&this.set(t,e,n,s)}identity(){return this.set(1,0,0,1),this}fromArray(t,e=0){for(let n=0;n<4;n++)this.elements[n]=t[n+e];return this}set(t,e,n,s){let r=this.elements;return r[0]=t,r[2]=e,r[1]=n,r[3]=s,this}};var Rr=class extends Pn{constructor(t,e=null){super(),this.object=t,this.domElement=e,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(t){this.domElement!==null&&this.disconnect(),this.domElement=t}disconnect(){}dispose(){}update(){}};function Oh(i,t,e,n){let s=j0(n);switch(e){case yh:return i*t;case bh:return i*t/s.components*s.byteLength;case Ma:return i*t/s.components*s.byteLength;case Ni:return i*t*2/s.components*s.byteLength;case ba:return i*t*2/s.components*s.byteLength;case Mh:return i*t*3/s.components*s.byteLength;case Ke:return i*t*4/s.components*s.byteLength;case Sa:return i*t*4/s.components*s.byteLength;case Lr:case Dr:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case Nr:case Or:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Ta:case Aa:return Math.max(i,16)*Math.max(t,8)/4;case wa:case Ea:return Math.max(i,8)*Math.max(t,8)/2;case Ca:case Ra:case Ia:case La:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case Pa:case Ur:case Da:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Na:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Oa:return Math.floor((i+4)/5)*Math.floor((t+3)/4)*16;case Ua:return Math.floor((i+4)/5)*Math.floor((t+4)/5)*16;case Fa:return Math.floor((i+5)/6)*Math.floor((t+4)/5)*16;case Ba:return Math.floor((i+5)/6)*Math.floor((t+5)/6)*16;case ka:return Math.floor((i+7)/8)*Math.floor((t+4)/5)*16;case za:return Math.floor((i+7)/8)*Math.floor((t+5)/6)*16;case Ga:return Math.floor((i+7)/8)*Math.floor((t+7)/8)*16;case Va:return Math.floor((i+9)/10)*Math.floor((t+4)/5)*16;case Ha:return Math.floor((i+9)/10)*Math.floor((t+5)/6)*16;case Wa:return Math.floor((i+9)/10)*Math.floor((t+7)/8)*16;case Xa:return Math.floor((i+9)/10)*Math.floor((t+9)/10)*16;case qa:return Math.floor((i+11)/12)*Math.floor((t+9)/10)*16;case $a:return Math.floor((i+11)/12)*Math.floor((t+11)/12)*16;case Ya:case Za:case Ja:return Math.ceil(i/4)*Math.ceil(t/4)*16;case Ka:case ja:return Math.ceil(i/4)*Math.ceil(t/4)*8;case Fr:case Qa:return Math.ceil(i/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function j0(i){switch(i){case Je:case gh:return{byteLength:1,components:1};case Ls:case _h:case Dn:return{byteLength:2,components:1};case va:case ya:return{byteLength:2,components:4};case Ln:case xa:case pn:return{byteLength:4,components:1};case xh:case vh:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${i}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Nt("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function up(){let i=null,t=!1,e=null,n=null;function s(r,o){n=i.requestAnimationFrame(s),e(r,o)}return{start:function(){t!==!0&&e!==null&&i!==null&&(n=i.requestAnimationFrame(s),t=!0)},stop:function(){i!==null&&i.cancelAnimationFrame(n),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){i=r}}}function t_(i){let t=new WeakMap;function e(a,l){let c=a.array,h=a.usage,u=c.byteLength,d=i.createBuffer();i.bindBuffer(l,d),i.bufferData(l,c,h),a.onUploadCallback();let f;if(c instanceof Float32Array)f=i.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)f=i.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?f=i.HALF_FLOAT:f=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)f=i.SHORT;else if(c instanceof Uint32Array)f=i.UNSIGNED_INT;else if(c instanceof Int32Array)f=i.INT;else if(c instanceof Int8Array)f=i.BYTE;else if(c instanceof Uint8Array)f=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)f=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:d,type:f,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function n(a,l,c){let h=l.array,u=l.updateRanges;if(i.bindBuffer(c,a),u.length===0)i.bufferSubData(c,0,h);else{u.sort((f,m)=>f.start-m.start);let d=0;for(let f=1;f<u.length;f++){let m=u[d],x=u[f];x.start<=m.start+m.count+1?m.count=Math.max(m.count,x.start+x.count-m.start):(++d,u[d]=x)}u.length=d+1;for(let f=0,m=u.length;f<m;f++){let x=u[f];i.bufferSubData(c,x.start*h.BYTES_PER_ELEMENT,h,x.start,x.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),t.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=t.get(a);l&&(i.deleteBuffer(l.buffer),t.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=t.get(a);(!h||h.version<a.version)&&t.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=t.get(a);if(c===void 0)t.set(a,e(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}var e_=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,n_=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,i_=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,s_=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,r_=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,o_=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,a_=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,l_=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,c_=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,h_=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,u_=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,d_=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,f_=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,p_=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,m_=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,g_=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,__=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,x_=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,v_=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,y_=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,M_=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,b_=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,S_=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,w_=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,T_=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,E_=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,A_=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,C_=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,R_=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,P_="gl_FragColor = linearToOutputTexel( gl_FragColor );",I_=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,L_=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,D_=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,N_=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,O_=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,U_=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,F_=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,B_=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,k_=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,z_=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,G_=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,V_=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,H_=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,W_=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,X_=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,q_=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,$_=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,Y_=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,Z_=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,J_=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,K_=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,j_=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,Q_=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,tx=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,ex=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,nx=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,ix=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,sx=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,rx=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,ox=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,ax=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,lx=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,cx=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,hx=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,ux=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,dx=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,fx=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,px=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,mx=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,gx=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,_x=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,xx=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,vx=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,yx=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Mx=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,bx=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,Sx=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,wx=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,Tx=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,Ex=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,Ax=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,Cx=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,Rx=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,Px=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,Ix=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,Lx=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,Dx=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,Nx=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,Ox=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,Ux=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,Fx=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,Bx=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,kx=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,zx=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,Gx=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,Vx=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,Hx=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,Wx=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,Xx=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,qx=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,$x=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,Yx=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,Zx=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,Jx=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,Kx=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,jx=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,Qx=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,tv=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,ev=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,nv=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,iv=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,sv=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,rv=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,ov=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,av=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,lv=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,cv=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,hv=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,uv=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,dv=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,fv=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,pv=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,mv=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,gv=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,_v=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,xv=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,vv=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,yv=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,Mv=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,bv=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Sv=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,wv=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,Tv=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Ev=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Av=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Cv=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,Rv=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Pv=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Iv=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Lv=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,Dv=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,Xt={alphahash_fragment:e_,alphahash_pars_fragment:n_,alphamap_fragment:i_,alphamap_pars_fragment:s_,alphatest_fragment:r_,alphatest_pars_fragment:o_,aomap_fragment:a_,aomap_pars_fragment:l_,batching_pars_vertex:c_,batching_vertex:h_,begin_vertex:u_,beginnormal_vertex:d_,bsdfs:f_,iridescence_fragment:p_,bumpmap_pars_fragment:m_,clipping_planes_fragment:g_,clipping_planes_pars_fragment:__,clipping_planes_pars_vertex:x_,clipping_planes_vertex:v_,color_fragment:y_,color_pars_fragment:M_,color_pars_vertex:b_,color_vertex:S_,common:w_,defaultnormal_vertex:T_,displacementmap_pars_vertex:E_,displacementmap_vertex:A_,emissivemap_fragment:C_,emissivemap_pars_fragment:R_,colorspace_fragment:P_,colorspace_pars_fragment:I_,envmap_fragment:L_,envmap_common_pars_fragment:D_,envmap_pars_fragment:N_,envmap_pars_vertex:O_,envmap_physical_pars_fragment:q_,envmap_vertex:U_,fog_vertex:F_,fog_pars_vertex:B_,fog_fragment:k_,fog_pars_fragment:z_,gradientmap_pars_fragment:G_,lightmap_pars_fragment:V_,lights_lambert_fragment:H_,lights_lambert_pars_fragment:W_,lights_pars_begin:X_,lights_toon_fragment:$_,lights_toon_pars_fragment:Y_,lights_phong_fragment:Z_,lights_phong_pars_fragment:J_,lights_physical_fragment:K_,lights_physical_pars_fragment:j_,lights_fragment_begin:Q_,lights_fragment_maps:tx,lights_fragment_end:ex,lightprobes_pars_fragment:nx,logdepthbuf_fragment:ix,logdepthbuf_pars_fragment:sx,logdepthbuf_pars_vertex:rx,logdepthbuf_vertex:ox,map_fragment:ax,map_pars_fragment:lx,map_particle_fragment:cx,map_particle_pars_fragment:hx,metalnessmap_fragment:ux,metalnessmap_pars_fragment:dx,morphinstance_vertex:fx,morphcolor_vertex:px,morphnormal_vertex:mx,morphtarget_pars_vertex:gx,morphtarget_vertex:_x,normal_fragment_begin:xx,normal_fragment_maps:vx,normal_pars_fragment:yx,normal_pars_vertex:Mx,normal_vertex:bx,normalmap_pars_fragment:Sx,clearcoat_normal_fragment_begin:wx,clearcoat_normal_fragment_maps:Tx,clearcoat_pars_fragment:Ex,iridescence_pars_fragment:Ax,opaque_fragment:Cx,packing:Rx,premultiplied_alpha_fragment:Px,project_vertex:Ix,dithering_fragment:Lx,dithering_pars_fragment:Dx,roughnessmap_fragment:Nx,roughnessmap_pars_fragment:Ox,shadowmap_pars_fragment:Ux,shadowmap_pars_vertex:Fx,shadowmap_vertex:Bx,shadowmask_pars_fragment:kx,skinbase_vertex:zx,skinning_pars_vertex:Gx,skinning_vertex:Vx,skinnormal_vertex:Hx,specularmap_fragment:Wx,specularmap_pars_fragment:Xx,tonemapping_fragment:qx,tonemapping_pars_fragment:$x,transmission_fragment:Yx,transmission_pars_fragment:Zx,uv_pars_fragment:Jx,uv_pars_vertex:Kx,uv_vertex:jx,worldpos_vertex:Qx,background_vert:tv,background_frag:ev,backgroundCube_vert:nv,backgroundCube_frag:iv,cube_vert:sv,cube_frag:rv,depth_vert:ov,depth_frag:av,distance_vert:lv,distance_frag:cv,equirect_vert:hv,equirect_frag:uv,linedashed_vert:dv,linedashed_frag:fv,meshbasic_vert:pv,meshbasic_frag:mv,meshlambert_vert:gv,meshlambert_frag:_v,meshmatcap_vert:xv,meshmatcap_frag:vv,meshnormal_vert:yv,meshnormal_frag:Mv,meshphong_vert:bv,meshphong_frag:Sv,meshphysical_vert:wv,meshphysical_frag:Tv,meshtoon_vert:Ev,meshtoon_frag:Av,points_vert:Cv,points_frag:Rv,shadow_vert:Pv,shadow_frag:Iv,sprite_vert:Lv,sprite_frag:Dv},xt={common:{diffuse:{value:new Bt(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new Ft},alphaMap:{value:null},alphaMapTransform:{value:new Ft},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new Ft}},envmap:{envMap:{value:null},envMapRotation:{value:new Ft},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new Ft}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new Ft}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new Ft},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new Ft},normalScale:{value:new Dt(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new Ft},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new Ft}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new Ft}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new Ft}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new Bt(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new Bt(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new Ft},alphaTest:{value:0},uvTransform:{value:new Ft}},sprite:{diffuse:{value:new Bt(16777215)},opacity:{value:1},center:{value:new Dt(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new Ft},alphaMap:{value:null},alphaMapTransform:{value:new Ft},alphaTest:{value:0}}},Yn={basic:{uniforms:We([xt.common,xt.specularmap,xt.envmap,xt.aomap,xt.lightmap,xt.fog]),vertexShader:Xt.meshbasic_vert,fragmentShader:Xt.meshbasic_frag},lambert:{uniforms:We([xt.common,xt.specularmap,xt.envmap,xt.aomap,xt.lightmap,xt.emissivemap,xt.bumpmap,xt.normalmap,xt.displacementmap,xt.fog,xt.lights,{emissive:{value:new Bt(0)},envMapIntensity:{value:1}}]),vertexShader:Xt.meshlambert_vert,fragmentShader:Xt.meshlambert_frag},phong:{uniforms:We([xt.common,xt.specularmap,xt.envmap,xt.aomap,xt.lightmap,xt.emissivemap,xt.bumpmap,xt.normalmap,xt.displacementmap,xt.fog,xt.lights,{emissive:{value:new Bt(0)},specular:{value:new Bt(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:Xt.meshphong_vert,fragmentShader:Xt.meshphong_frag},standard:{uniforms:We([xt.common,xt.envmap,xt.aomap,xt.lightmap,xt.emissivemap,xt.bumpmap,xt.normalmap,xt.displacementmap,xt.roughnessmap,xt.metalnessmap,xt.fog,xt.lights,{emissive:{value:new Bt(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:Xt.meshphysical_vert,fragmentShader:Xt.meshphysical_frag},toon:{uniforms:We([xt.common,xt.aomap,xt.lightmap,xt.emissivemap,xt.bumpmap,xt.normalmap,xt.displacementmap,xt.gradientmap,xt.fog,xt.lights,{emissive:{value:new Bt(0)}}]),vertexShader:Xt.meshtoon_vert,fragmentShader:Xt.meshtoon_frag},matcap:{uniforms:We([xt.common,xt.bumpmap,xt.normalmap,xt.displacementmap,xt.fog,{matcap:{value:null}}]),vertexShader:Xt.meshmatcap_vert,fragmentShader:Xt.meshmatcap_frag},points:{uniforms:We([xt.points,xt.fog]),vertexShader:Xt.points_vert,fragmentShader:Xt.points_frag},dashed:{uniforms:We([xt.common,xt.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:Xt.linedashed_vert,fragmentShader:Xt.linedashed_frag},depth:{uniforms:We([xt.common,xt.displacementmap]),vertexShader:Xt.depth_vert,fragmentShader:Xt.depth_frag},normal:{uniforms:We([xt.common,xt.bumpmap,xt.normalmap,xt.displacementmap,{opacity:{value:1}}]),vertexShader:Xt.meshnormal_vert,fragmentShader:Xt.meshnormal_frag},sprite:{uniforms:We([xt.sprite,xt.fog]),vertexShader:Xt.sprite_vert,fragmentShader:Xt.sprite_frag},background:{uniforms:{uvTransform:{value:new Ft},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:Xt.background_vert,fragmentShader:Xt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new Ft}},vertexShader:Xt.backgroundCube_vert,fragmentShader:Xt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:Xt.cube_vert,fragmentShader:Xt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:Xt.equirect_vert,fragmentShader:Xt.equirect_frag},distance:{uniforms:We([xt.common,xt.displacementmap,{referencePosition:{value:new O},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:Xt.distance_vert,fragmentShader:Xt.distance_frag},shadow:{uniforms:We([xt.lights,xt.fog,{color:{value:new Bt(0)},opacity:{value:1}}]),vertexShader:Xt.shadow_vert,fragmentShader:Xt.shadow_frag}};Yn.physical={uniforms:We([Yn.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new Ft},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new Ft},clearcoatNormalScale:{value:new Dt(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new Ft},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new Ft},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new Ft},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new Ft},sheen:{value:0},sheenColor:{value:new Bt(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new Ft},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new Ft},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new Ft},transmissionSamplerSize:{value:new Dt},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new Ft},attenuationDistance:{value:0},attenuationColor:{value:new Bt(0)},specularColor:{value:new Bt(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new Ft},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new Ft},anisotropyVector:{value:new Dt},anisotropyMap:{value:null},anisotropyMapTransform:{value:new Ft}}]),vertexShader:Xt.meshphysical_vert,fragmentShader:Xt.meshphysical_frag};var tl={r:0,b:0,g:0},Nv=new Qt,dp=new Ft;dp.set(-1,0,0,0,1,0,0,0,1);function Ov(i,t,e,n,s,r){let o=new Bt(0),a=s===!0?0:1,l,c,h=null,u=0,d=null;function f(S){let w=S.isScene===!0?S.background:null;if(w&&w.isTexture){let b=S.backgroundBlurriness>0;w=t.get(w,b)}return w}function m(S){let w=!1,b=f(S);b===null?p(o,a):b&&b.isColor&&(p(b,1),w=!0);let C=i.xr.getEnvironmentBlendMode();C==="additive"?e.buffers.color.setClear(0,0,0,1,r):C==="alpha-blend"&&e.buffers.color.setClear(0,0,0,0,r),(i.autoClear||w)&&(e.buffers.depth.setTest(!0),e.buffers.depth.setMask(!0),e.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function x(S,w){let b=f(w);b&&b.isCubeTexture?(c===void 0&&(c=new en(new Ts(1,1,1),new Hn({name:"BackgroundCubeMaterial",uniforms:ji(Yn.backgroundCube.uniforms),vertexShader:Yn.backgroundCube.vertexShader,fragmentShader:Yn.backgroundCube.fragmentShader,side:Be,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(C,A,_){this.matrixWorld.copyPosition(_.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),n.update(c)),c.material.uniforms.envMap.value=b,c.material.uniforms.backgroundBlurriness.value=w.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=w.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(Nv.makeRotationFromEuler(w.backgroundRotation)).transpose(),b.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(dp),c.material.toneMapped=Kt.getTransfer(b.colorSpace)!==oe,(h!==b||u!==b.version||d!==i.toneMapping)&&(c.material.needsUpdate=!0,h=b,u=b.version,d=i.toneMapping),c.layers.enableAll(),S.unshift(c,c.geometry,c.material,0,0,null)):b&&b.isTexture&&(l===void 0&&(l=new en(new Tr(2,2),new Hn({name:"BackgroundMaterial",uniforms:ji(Yn.background.uniforms),vertexShader:Yn.background.vertexShader,fragmentShader:Yn.background.fragmentShader,side:Di,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),n.update(l)),l.material.uniforms.t2D.value=b,l.material.uniforms.backgroundIntensity.value=w.backgroundIntensity,l.material.toneMapped=Kt.getTransfer(b.colorSpace)!==oe,b.matrixAutoUpdate===!0&&b.updateMatrix(),l.material.uniforms.uvTransform.value.copy(b.matrix),(h!==b||u!==b.version||d!==i.toneMapping)&&(l.material.needsUpdate=!0,h=b,u=b.version,d=i.toneMapping),l.layers.enableAll(),S.unshift(l,l.geometry,l.material,0,0,null))}function p(S,w){S.getRGB(tl,Lh(i)),e.buffers.color.setClear(tl.r,tl.g,tl.b,w,r)}function g(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(S,w=1){o.set(S),a=w,p(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(S){a=S,p(o,a)},render:m,addToRenderList:x,dispose:g}}function Uv(i,t){let e=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=d(null),r=s,o=!1;function a(N,z,Y,I,X){let $=!1,V=u(N,I,Y,z);r!==V&&(r=V,c(r.object)),$=f(N,I,Y,X),$&&m(N,I,Y,X),X!==null&&t.update(X,i.ELEMENT_ARRAY_BUFFER),($||o)&&(o=!1,b(N,z,Y,I),X!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,t.get(X).buffer))}function l(){return i.createVertexArray()}function c(N){return i.bindVertexArray(N)}function h(N){return i.deleteVertexArray(N)}function u(N,z,Y,I){let X=I.wireframe===!0,$=n[z.id];$===void 0&&($={},n[z.id]=$);let V=N.isInstancedMesh===!0?N.id:0,it=$[V];it===void 0&&(it={},$[V]=it);let W=it[Y.id];W===void 0&&(W={},it[Y.id]=W);let tt=W[X];return tt===void 0&&(tt=d(l()),W[X]=tt),tt}function d(N){let z=[],Y=[],I=[];for(let X=0;X<e;X++)z[X]=0,Y[X]=0,I[X]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:z,enabledAttributes:Y,attributeDivisors:I,object:N,attributes:{},index:null}}function f(N,z,Y,I){let X=r.attributes,$=z.attributes,V=0,it=Y.getAttributes();for(let W in it)if(it[W].location>=0){let et=X[W],Mt=$[W];if(Mt===void 0&&(W==="instanceMatrix"&&N.instanceMatrix&&(Mt=N.instanceMatrix),W==="instanceColor"&&N.instanceColor&&(Mt=N.instanceColor)),et===void 0||et.attribute!==Mt||Mt&&et.data!==Mt.data)return!0;V++}return r.attributesNum!==V||r.index!==I}function m(N,z,Y,I){let X={},$=z.attributes,V=0,it=Y.getAttributes();for(let W in it)if(it[W].location>=0){let et=$[W];et===void 0&&(W==="instanceMatrix"&&N.instanceMatrix&&(et=N.instanceMatrix),W==="instanceColor"&&N.instanceColor&&(et=N.instanceColor));let Mt={};Mt.attribute=et,et&&et.data&&(Mt.data=et.data),X[W]=Mt,V++}r.attributes=X,r.attributesNum=V,r.index=I}function x(){let N=r.newAttributes;for(let z=0,Y=N.length;z<Y;z++)N[z]=0}function p(N){g(N,0)}function g(N,z){let Y=r.newAttributes,I=r.enabledAttributes,X=r.attributeDivisors;Y[N]=1,I[N]===0&&(i.enableVertexAttribArray(N),I[N]=1),X[N]!==z&&(i.vertexAttribDivisor(N,z),X[N]=z)}function S(){let N=r.newAttributes,z=r.enabledAttributes;for(let Y=0,I=z.length;Y<I;Y++)z[Y]!==N[Y]&&(i.disableVertexAttribArray(Y),z[Y]=0)}function w(N,z,Y,I,X,$,V){V===!0?i.vertexAttribIPointer(N,z,Y,X,$):i.vertexAttribPointer(N,z,Y,I,X,$)}function b(N,z,Y,I){x();let X=I.attributes,$=Y.getAttributes(),V=z.defaultAttributeValues;for(let it in $){let W=$[it];if(W.location>=0){let tt=X[it];if(tt===void 0&&(it==="instanceMatrix"&&N.instanceMatrix&&(tt=N.instanceMatrix),it==="instanceColor"&&N.instanceColor&&(tt=N.instanceColor)),tt!==void 0){let et=tt.normalized,Mt=tt.itemSize,It=t.get(tt);if(It===void 0)continue;let J=It.buffer,pt=It.type,yt=It.bytesPerElement,Ct=pt===i.INT||pt===i.UNSIGNED_INT||tt.gpuType===xa;if(tt.isInterleavedBufferAttribute){let gt=tt.data,Ut=gt.isInterleavedBuffer===!0?gt.stride:gt.itemSize,xe=tt.offset;if(gt.isInstancedInterleavedBuffer||gt.isInstancedBufferAttribute){for(let Pt=0;Pt<W.locationSize;Pt++)g(W.location+Pt,gt.meshPerAttribute);N.isInstancedMesh!==!0&&I._maxInstanceCount===void 0&&(I._maxInstanceCount=gt.meshPerAttribute*gt.count)}else for(let Pt=0;Pt<W.locationSize;Pt++)p(W.location+Pt);i.bindBuffer(i.ARRAY_BUFFER,J);for(let Pt=0;Pt<W.locationSize;Pt++)w(W.location+Pt,Mt/W.locationSize,pt,et,Ut*yt,(xe+Mt/W.locationSize*Pt)*yt,Ct)}else{if(tt.isInstancedBufferAttribute){for(let gt=0;gt<W.locationSize;gt++)g(W.location+gt,tt.meshPerAttribute);N.isInstancedMesh!==!0&&I._maxInstanceCount===void 0&&(I._maxInstanceCount=tt.meshPerAttribute*tt.count)}else for(let gt=0;gt<W.locationSize;gt++)p(W.location+gt);i.bindBuffer(i.ARRAY_BUFFER,J);for(let gt=0;gt<W.locationSize;gt++)w(W.location+gt,Mt/W.locationSize,pt,et,Mt*yt,Mt/W.locationSize*gt*yt,Ct)}}else if(V!==void 0){let et=V[it];if(et!==void 0)switch(et.length){case 2:i.vertexAttrib2fv(W.location,et);break;case 3:i.vertexAttrib3fv(W.location,et);break;case 4:i.vertexAttrib4fv(W.location,et);break;default:i.vertexAttrib1fv(W.location,et)}}}}S()}function C(){F();for(let N in n){let z=n[N];for(let Y in z){let I=z[Y];for(let X in I){let $=I[X];for(let V in $)h($[V].object),delete $[V];delete I[X]}}delete n[N]}}function A(N){if(n[N.id]===void 0)return;let z=n[N.id];for(let Y in z){let I=z[Y];for(let X in I){let $=I[X];for(let V in $)h($[V].object),delete $[V];delete I[X]}}delete n[N.id]}function _(N){for(let z in n){let Y=n[z];for(let I in Y){let X=Y[I];if(X[N.id]===void 0)continue;let $=X[N.id];for(let V in $)h($[V].object),delete $[V];delete X[N.id]}}}function T(N){for(let z in n){let Y=n[z],I=N.isInstancedMesh===!0?N.id:0,X=Y[I];if(X!==void 0){for(let $ in X){let V=X[$];for(let it in V)h(V[it].object),delete V[it];delete X[$]}delete Y[I],Object.keys(Y).length===0&&delete n[z]}}}function F(){L(),o=!0,r!==s&&(r=s,c(r.object))}function L(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:F,resetDefaultState:L,dispose:C,releaseStatesOfGeometry:A,releaseStatesOfObject:T,releaseStatesOfProgram:_,initAttributes:x,enableAttribute:p,disableUnusedAttributes:S}}function Fv(i,t,e){let n;function s(l){n=l}function r(l,c){i.drawArrays(n,l,c),e.update(c,n,1)}function o(l,c,h){h!==0&&(i.drawArraysInstanced(n,l,c,h),e.update(c,n,h))}function a(l,c,h){if(h===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,l,0,c,0,h);let d=0;for(let f=0;f<h;f++)d+=c[f];e.update(d,n,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function Bv(i,t,e,n){let s;function r(){if(s!==void 0)return s;if(t.has("EXT_texture_filter_anisotropic")===!0){let _=t.get("EXT_texture_filter_anisotropic");s=i.getParameter(_.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(_){return!(_!==Ke&&n.convert(_)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(_){let T=_===Dn&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(_!==Je&&_!==pn&&!T&&n.convert(_)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE))}function l(_){if(_==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";_="mediump"}return _==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=e.precision!==void 0?e.precision:"highp",h=l(c);h!==c&&(Nt("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=e.reversedDepthBuffer===!0&&t.has("EXT_clip_control"),d=e.logarithmicDepthBuffer===!0&&u===!1;e.reversedDepthBuffer===!0&&u===!1&&Nt("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),e.logarithmicDepthBuffer===!0&&u===!0&&Nt("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let f=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),m=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),x=i.getParameter(i.MAX_TEXTURE_SIZE),p=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),g=i.getParameter(i.MAX_VERTEX_ATTRIBS),S=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),w=i.getParameter(i.MAX_VARYING_VECTORS),b=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),C=i.getParameter(i.MAX_SAMPLES),A=i.getParameter(i.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:d,reversedDepthBuffer:u,maxTextures:f,maxVertexTextures:m,maxTextureSize:x,maxCubemapSize:p,maxAttributes:g,maxVertexUniforms:S,maxVaryings:w,maxFragmentUniforms:b,maxSamples:C,samples:A}}function kv(i){let t=this,e=null,n=0,s=!1,r=!1,o=new qe,a=new Ft,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,d){let f=u.length!==0||d||n!==0||s;return s=d,n=u.length,f},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,d){e=h(u,d,0)},this.setState=function(u,d,f){let m=u.clippingPlanes,x=u.clipIntersection,p=u.clipShadows,g=i.get(u);if(!s||m===null||m.length===0||r&&!p)r?h(null):c();else{let S=r?0:n,w=S*4,b=g.clippingState||null;l.value=b,b=h(m,d,w,f);for(let C=0;C!==w;++C)b[C]=e[C];g.clippingState=b,this.numIntersection=x?this.numPlanes:0,this.numPlanes+=S}};function c(){l.value!==e&&(l.value=e,l.needsUpdate=n>0),t.numPlanes=n,t.numIntersection=0}function h(u,d,f,m){let x=u!==null?u.length:0,p=null;if(x!==0){if(p=l.value,m!==!0||p===null){let g=f+x*4,S=d.matrixWorldInverse;a.getNormalMatrix(S),(p===null||p.length<g)&&(p=new Float32Array(g));for(let w=0,b=f;w!==x;++w,b+=4)o.copy(u[w]).applyMatrix4(S,a),o.normal.toArray(p,b),p[b+3]=o.constant}l.value=p,l.needsUpdate=!0}return t.numPlanes=x,t.numIntersection=0,p}}var zr=class extends hn{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;let n={width:t,height:t,depth:1},s=[n,n,n,n,n,n];this.texture=new xr(s),this._setTextureOptions(e),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;let n={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new Ts(5,5,5),r=new Hn({name:"CubemapFromEquirect",uniforms:ji(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:Be,blending:Yi});r.uniforms.tEquirect.value=e;let o=new en(s,r),a=e.minFilter;return e.minFilter===ci&&(e.minFilter=Ze),new As(1,10,this).update(t,o),e.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(t,e=!0,n=!0,s=!0){let r=t.getRenderTarget();for(let o=0;o<6;o++)t.setRenderTarget(this,o),t.clear(e,n,s);t.setRenderTarget(r)}},Wf=256,zv=3,Gv=20,fp=256,pp=16,Vv=3,Hv=new O,Wv=new Bt,nl=class i{constructor(t){this._renderer=t,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new As(1,10,null),this._boxMesh=new en(new Ts(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(t,e=0,n=.1,s=100,r={}){let{size:o=256,position:a=Hv}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),h=this._getSourceTarget(!0);e>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,d=l.autoClearColor,f=l.autoClearDepth,m=l.autoClearStencil,x=t.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,x===null&&(t.background=l.getClearColor(Wv));let p=new As(n,s,h);return p.position.copy(a),p.update(l,t),l.autoClear=u,l.autoClearColor=d,l.autoClearDepth=f,l.autoClearStencil=m,t.background=x,e>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,e)),this._applyPMREM(c),c}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=$f(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=qf(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(t,e){return e>0?1-Math.sqrt(1-t/e):0}_setSize(t){this._cubeSize=Math.max(Wf,Rh(t))}_fromTexture(t,e){t.mapping===Ji||t.mapping===Is?this._setSize(t.image.length===0?Wf:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4);let n=e||this._allocateTarget();return this._textureToCubemap(t),this._applyPMREM(n),n}_allocateTarget(){let t=this._cubeSize,e=Xf(t,!1,!1),n=Math.log2(t)-zv;for(let s=0;s<=n;s++)e.texture.mipmaps.push({width:t>>s,height:t>>s});return e.texture.name="PMREM",e.texture.isPMREMTexture=!0,e}_getSourceTarget(t=!1){let e=this._cubeSize,n=this._sourceTarget;return(n===null||n.width!==e||t&&n.depthBuffer===!1)&&(n!==null&&n.dispose(),this._sourceTarget=Xf(e,!0,t)),this._sourceTarget}_compileMaterial(t){this._boxMesh.material=t,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(t,e,n){let s=this._boxMesh,r=this._cubeCamera;s.material=n,r.renderTarget=t,r.activeMipmapLevel=e;let o=t.width>>e;t.viewport.set(0,0,o,o),r.update(this._renderer,s),t.viewport.set(0,0,t.width,t.height)}_textureToCubemap(t){let e;t.mapping===Ji||t.mapping===Is?(this._cubemapMaterial===null&&(this._cubemapMaterial=$f()),e=this._cubemapMaterial,e.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=qf()),e=this._equirectMaterial),e.uniforms.envMap.value=t,this._renderCube(this._getSourceTarget(),0,e)}_applyPMREM(t){this._ggxMaterial===null&&(this._ggxMaterial=Xv(),this._integrationMaterial=qv());let e=this._cubeSize,n=t.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(e/pp);for(let o=0;o<=n;o++){let a=i.lodToRoughness(o,n);if(o>n-Vv)r.roughness.value=a,this._renderCube(t,o,this._integrationMaterial);else{let l=a>0?Math.log2(e)+.5*Math.log2(6/(fp*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=l,this._renderCube(t,o,this._ggxMaterial)}}}_blur(t,e){this._blurMaterial===null&&(this._blurMaterial=$v());let n=this._blurMaterial,s=n.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(e,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(t,0,n),s.envMap.value=t.texture,this._renderCube(r,0,n)}};function Xf(i,t,e){return new zr(i,{minFilter:ci,generateMipmaps:t,type:Dn,colorSpace:cr,depthBuffer:e})}function Gr(i,t,e){return new Hn({name:i,uniforms:t,vertexShader:Xt.cube_vert,fragmentShader:e,side:Be,blending:Yi,depthTest:!1,depthWrite:!1})}function Xv(){return Gr("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${fp}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function qv(){return Gr("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:pp}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function $v(){return Gr("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${Gv}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function qf(){return Gr("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function $f(){return Gr("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function Yv(i){let t=new WeakMap,e=new WeakMap,n=null;function s(d,f=!1){return d==null?null:f?o(d):r(d)}function r(d){if(d&&d.isTexture){let f=d.mapping;if(f===ma||f===ga)if(t.has(d)){let m=t.get(d).texture;return a(m,d.mapping)}else{let m=d.image;if(m&&m.height>0){let x=new zr(m.height);return x.fromEquirectangularTexture(i,d),t.set(d,x),d.addEventListener("dispose",c),a(x.texture,d.mapping)}else return null}}return d}function o(d){if(d&&d.isTexture&&d.isPMREMTexture!==!0){let f=d.mapping,m=f===ma||f===ga,x=f===Ji||f===Is;if(m||x){let p=e.get(d),g=p!==void 0?p.texture.pmremVersion:0;if(d.isRenderTargetTexture&&d.pmremVersion!==g)return n===null&&(n=new nl(i)),p=m?n.fromEquirectangular(d,p):n.fromCubemap(d,p),p.texture.pmremVersion=d.pmremVersion,e.set(d,p),p.texture;if(p!==void 0)return p.texture;{let S=d.image;return m&&S&&S.height>0||x&&S&&l(S)?(n===null&&(n=new nl(i)),p=m?n.fromEquirectangular(d):n.fromCubemap(d),p.texture.pmremVersion=d.pmremVersion,e.set(d,p),d.addEventListener("dispose",h),p.texture):null}}}return d}function a(d,f){return f===ma?d.mapping=Ji:f===ga&&(d.mapping=Is),d}function l(d){let f=0,m=6;for(let x=0;x<m;x++)d[x]!==void 0&&f++;return f===m}function c(d){let f=d.target;f.removeEventListener("dispose",c);let m=t.get(f);m!==void 0&&(t.delete(f),m.dispose())}function h(d){let f=d.target;f.removeEventListener("dispose",h);let m=e.get(f);m!==void 0&&(e.delete(f),m.dispose())}function u(){t=new WeakMap,e=new WeakMap,n!==null&&(n.dispose(),n=null)}return{get:s,dispose:u}}function Zv(i){let t={};function e(n){if(t[n]!==void 0)return t[n];let s=i.getExtension(n);return t[n]=s,s}return{has:function(n){return e(n)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(n){let s=e(n);return s===null&&rr("WebGLRenderer: "+n+" extension not supported."),s}}}function Jv(i,t,e,n){let s={},r=new WeakMap,o=new FinalizationRegistry(m=>delete s[m]);function a(m){l(m.target)}function l(m){m.index!==null&&t.remove(m.index);for(let p in m.attributes)t.remove(m.attributes[p]);m.removeEventListener("dispose",a),delete s[m.id],o.unregister(m);let x=r.get(m);x&&(t.remove(x),r.delete(m)),n.releaseStatesOfGeometry(m),m.isInstancedBufferGeometry===!0&&delete m._maxInstanceCount,e.memory.geometries--}function c(m,x){return s[x.id]!==void 0||(x.addEventListener("dispose",a),s[x.id]=new WeakRef(x),o.register(x,x.id,x),e.memory.geometries++),x}function h(m){let x=m.attributes;for(let p in x)t.update(x[p],i.ARRAY_BUFFER)}function u(m){let x=m.index,p=m.attributes.position,g=0;if(p===void 0)return;let S=x!==null?x.array.length:p.array.length/3-1,w=p.count>=65535?gr:mr,b=new w(Math.ceil(S/3)*6,1),C=b.array;if(x!==null){let _=x.array;g=x.version;for(let T=0,F=0;T<S;T+=3){let L=_[T+0],N=_[T+1],z=_[T+2];C[F++]=L,C[F++]=N,C[F++]=N,C[F++]=z,C[F++]=z,C[F++]=L}}else{g=p.version;for(let _=0,T=0;_<S;_+=3){let F=_+0,L=_+1,N=_+2;C[T++]=F,C[T++]=L,C[T++]=L,C[T++]=N,C[T++]=N,C[T++]=F}}b.version=g;let A=r.get(m);A&&t.remove(A),r.set(m,b)}function d(m){let x=r.get(m);if(x){let p=m.index;p!==null&&x.version<p.version&&u(m)}else u(m);return r.get(m)}function f(){for(let m in s){let x=s[m].deref();x!==void 0&&l(x)}}return{get:c,update:h,getWireframeAttribute:d,dispose:f}}function Kv(i,t,e){let n;function s(u){n=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,d){i.drawElements(n,d,r,u*o),e.update(d,n,1)}function c(u,d,f){f!==0&&(i.drawElementsInstanced(n,d,r,u*o,f),e.update(d,n,f))}function h(u,d,f){if(f===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,d,0,r,u,0,f);let x=0;for(let p=0;p<f;p++)x+=d[p];e.update(x,n,1)}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function jv(i){let t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,o,a){switch(e.calls++,o){case i.TRIANGLES:e.triangles+=a*(r/3);break;case i.LINES:e.lines+=a*(r/2);break;case i.LINE_STRIP:e.lines+=a*(r-1);break;case i.LINE_LOOP:e.lines+=a*r;break;case i.POINTS:e.points+=a*r;break;default:Ot("WebGLInfo: Unknown draw mode:",o);break}}function s(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:s,update:n}}function Qv(i,t,e){let n=new WeakMap,s=new _e;function r(o,a,l){let c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,d=n.get(a);if(d===void 0||d.count!==u){let F=function(){_.dispose(),n.delete(a),a.removeEventListener("dispose",F)};d!==void 0&&d.texture.dispose();let f=a.morphAttributes.position!==void 0,m=a.morphAttributes.normal!==void 0,x=a.morphAttributes.color!==void 0,p=a.morphAttributes.position||[],g=a.morphAttributes.normal||[],S=a.morphAttributes.color||[],w=0;f===!0&&(w=1),m===!0&&(w=2),x===!0&&(w=3);let b=a.attributes.position.count*w,C=1;b>t.maxTextureSize&&(C=Math.ceil(b/t.maxTextureSize),b=t.maxTextureSize);let A=new Float32Array(b*C*4*u),_=new fr(A,b,C,u);_.type=pn,_.needsUpdate=!0;let T=w*4;for(let L=0;L<u;L++){let N=p[L],z=g[L],Y=S[L],I=b*C*4*L;for(let X=0;X<N.count;X++){let $=X*T;f===!0&&(s.fromBufferAttribute(N,X),A[I+$+0]=s.x,A[I+$+1]=s.y,A[I+$+2]=s.z,A[I+$+3]=0),m===!0&&(s.fromBufferAttribute(z,X),A[I+$+4]=s.x,A[I+$+5]=s.y,A[I+$+6]=s.z,A[I+$+7]=0),x===!0&&(s.fromBufferAttribute(Y,X),A[I+$+8]=s.x,A[I+$+9]=s.y,A[I+$+10]=s.z,A[I+$+11]=Y.itemSize===4?s.w:1)}}d={count:u,texture:_,size:new Dt(b,C)},n.set(a,d),a.addEventListener("dispose",F)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",o.morphTexture,e);else{let f=0;for(let x=0;x<c.length;x++)f+=c[x];let m=a.morphTargetsRelative?1:1-f;l.getUniforms().setValue(i,"morphTargetBaseInfluence",m),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",d.texture,e),l.getUniforms().setValue(i,"morphTargetsTextureSize",d.size)}return{update:r}}function ty(i,t,e,n,s){let r=new WeakMap;function o(c){let h=s.render.frame,u=c.geometry,d=t.get(c,u);if(r.get(d)!==h&&(t.update(d),r.set(d,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(e.update(c.instanceMatrix,i.ARRAY_BUFFER),c.instanceColor!==null&&e.update(c.instanceColor,i.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let f=c.skeleton;r.get(f)!==h&&(f.update(),r.set(f,h))}return d}function a(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),n.releaseStatesOfObject(h),e.remove(h.instanceMatrix),h.instanceColor!==null&&e.remove(h.instanceColor)}return{update:o,dispose:a}}var ey={[lh]:"LINEAR_TONE_MAPPING",[ch]:"REINHARD_TONE_MAPPING",[hh]:"CINEON_TONE_MAPPING",[uh]:"ACES_FILMIC_TONE_MAPPING",[fh]:"AGX_TONE_MAPPING",[ph]:"NEUTRAL_TONE_MAPPING",[dh]:"CUSTOM_TONE_MAPPING"};function ny(i,t,e,n,s,r){let o=new hn(t,e,{type:i,depthBuffer:s,stencilBuffer:r,samples:n?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,h=new tn;h.setAttribute("position",new Ye([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new Ye([0,2,0,0,2,0],2));let u=new Wn({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),d=new en(h,u),f=new fa(-1,1,1,-1,0,1),m=null,x=null,p=!1,g,S=null,w=[],b=!1;this.setSize=function(C,A){o.setSize(C,A),a!==null&&a.setSize(C,A),l!==null&&l.setSize(C,A);for(let _=0;_<w.length;_++){let T=w[_];T.setSize&&T.setSize(C,A)}},this.setEffects=function(C){w=C,b=w.length>0&&w[0].isRenderPass===!0;let A=o.width,_=o.height;w.length>0&&a===null&&(a=new hn(A,_,{type:Dn,depthBuffer:!1,stencilBuffer:!1}),l=new hn(A,_,{type:Dn,depthBuffer:!1,stencilBuffer:!1}));let T=s===!0&&w.some(F=>F.needsDepthTexture===!0);T!==(o.depthTexture!==null)&&(T===!0&&c===null&&(c=new li(A,_),r===!0&&(c.format=hi,c.type=Ki)),o.dispose(),o.depthTexture=T?c:null,o.resolveDepthBuffer=T,o.storeMultisampledDepthBuffer=T);for(let F=0;F<w.length;F++){let L=w[F];L.setSize&&L.setSize(A,_),T&&L.needsDepthTexture===!0&&L.setDepthTexture&&L.setDepthTexture(c)}},this.begin=function(C,A){if(p||C.toneMapping===qn&&w.length===0)return!1;if(S=A,A!==null){let _=A.width,T=A.height;(o.width!==_||o.height!==T)&&this.setSize(_,T)}return b===!1&&C.setRenderTarget(o),g=C.toneMapping,C.toneMapping=qn,!0},this.hasRenderPass=function(){return b},this.end=function(C,A){C.toneMapping=g,p=!0;let _=o,T=a;for(let F=0;F<w.length;F++){let L=w[F];L.enabled!==!1&&(L.render(C,T,_,A),L.needsSwap!==!1&&(_=T,T=T===a?l:a))}if(m!==C.outputColorSpace||x!==C.toneMapping){m=C.outputColorSpace,x=C.toneMapping,u.defines={},Kt.getTransfer(m)===oe&&(u.defines.SRGB_TRANSFER="");let F=ey[x];F&&(u.defines[F]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=_.texture,C.setRenderTarget(S),C.render(d,f),S=null,p=!1},this.isCompositing=function(){return p},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var mp=new Qe,gp=new li(1,1),_p=new vr(1),xp=new fr,vp=new Ko,yp=new xr,Yf=[],Zf=[],Jf=new Float32Array(16),Kf=new Float32Array(9),jf=new Float32Array(4);function Os(i,t,e){let n=i[0];if(n<=0||n>0)return i;let s=t*e,r=Yf[s];if(r===void 0&&(r=new Float32Array(s),Yf[s]=r),t!==0){n.toArray(r,0);for(let o=1,a=0;o!==t;++o)a+=e,i[o].toArray(r,a)}return r}function Ce(i,t){if(i.length!==t.length)return!1;for(let e=0,n=i.length;e<n;e++)if(i[e]!==t[e])return!1;return!0}function Re(i,t){for(let e=0,n=t.length;e<n;e++)i[e]=t[e]}function sl(i,t){let e=Zf[t];e===void 0&&(e=new Int32Array(t),Zf[t]=e);for(let n=0;n!==t;++n)e[n]=i.allocateTextureUnit();return e}function iy(i,t){let e=this.cache;e[0]!==t&&(i.uniform1f(this.addr,t),e[0]=t)}function sy(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Ce(e,t))return;i.uniform2fv(this.addr,t),Re(e,t)}}function ry(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(i.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(Ce(e,t))return;i.uniform3fv(this.addr,t),Re(e,t)}}function oy(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Ce(e,t))return;i.uniform4fv(this.addr,t),Re(e,t)}}function ay(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(Ce(e,t))return;i.uniformMatrix2fv(this.addr,!1,t),Re(e,t)}else{if(Ce(e,n))return;jf.set(n),i.uniformMatrix2fv(this.addr,!1,jf),Re(e,n)}}function ly(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(Ce(e,t))return;i.uniformMatrix3fv(this.addr,!1,t),Re(e,t)}else{if(Ce(e,n))return;Kf.set(n),i.uniformMatrix3fv(this.addr,!1,Kf),Re(e,n)}}function cy(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(Ce(e,t))return;i.uniformMatrix4fv(this.addr,!1,t),Re(e,t)}else{if(Ce(e,n))return;Jf.set(n),i.uniformMatrix4fv(this.addr,!1,Jf),Re(e,n)}}function hy(i,t){let e=this.cache;e[0]!==t&&(i.uniform1i(this.addr,t),e[0]=t)}function uy(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Ce(e,t))return;i.uniform2iv(this.addr,t),Re(e,t)}}function dy(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Ce(e,t))return;i.uniform3iv(this.addr,t),Re(e,t)}}function fy(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Ce(e,t))return;i.uniform4iv(this.addr,t),Re(e,t)}}function py(i,t){let e=this.cache;e[0]!==t&&(i.uniform1ui(this.addr,t),e[0]=t)}function my(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Ce(e,t))return;i.uniform2uiv(this.addr,t),Re(e,t)}}function gy(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Ce(e,t))return;i.uniform3uiv(this.addr,t),Re(e,t)}}function _y(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Ce(e,t))return;i.uniform4uiv(this.addr,t),Re(e,t)}}function rl(i){return i.version===0&&(i.compareFunction=Eh,i.needsUpdate=!0),i}function xy(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_2D_SHADOW?r=rl(gp):r=mp,e.setTexture2D(t||r,s)}function vy(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture3D(t||vp,s)}function yy(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_CUBE_SHADOW?r=rl(_p):r=yp,e.setTextureCube(t||r,s)}function My(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture2DArray(t||xp,s)}function by(i){switch(i){case 5126:return iy;case 35664:return sy;case 35665:return ry;case 35666:return oy;case 35674:return ay;case 35675:return ly;case 35676:return cy;case 5124:case 35670:return hy;case 35667:case 35671:return uy;case 35668:case 35672:return dy;case 35669:case 35673:return fy;case 5125:return py;case 36294:return my;case 36295:return gy;case 36296:return _y;case 35678:case 36198:case 36298:case 36306:case 35682:return xy;case 35679:case 36299:case 36307:return vy;case 35680:case 36300:case 36308:case 36293:return yy;case 36289:case 36303:case 36311:case 36292:return My}}function Sy(i,t){i.uniform1fv(this.addr,t)}function wy(i,t){let e=Os(t,this.size,2);i.uniform2fv(this.addr,e)}function Ty(i,t){let e=Os(t,this.size,3);i.uniform3fv(this.addr,e)}function Ey(i,t){let e=Os(t,this.size,4);i.uniform4fv(this.addr,e)}function Ay(i,t){let e=Os(t,this.size,4);i.uniformMatrix2fv(this.addr,!1,e)}function Cy(i,t){let e=Os(t,this.size,9);i.uniformMatrix3fv(this.addr,!1,e)}function Ry(i,t){let e=Os(t,this.size,16);i.uniformMatrix4fv(this.addr,!1,e)}function Py(i,t){i.uniform1iv(this.addr,t)}function Iy(i,t){i.uniform2iv(this.addr,t)}function Ly(i,t){i.uniform3iv(this.addr,t)}function Dy(i,t){i.uniform4iv(this.addr,t)}function Ny(i,t){i.uniform1uiv(this.addr,t)}function Oy(i,t){i.uniform2uiv(this.addr,t)}function Uy(i,t){i.uniform3uiv(this.addr,t)}function Fy(i,t){i.uniform4uiv(this.addr,t)}function By(i,t,e){let n=this.cache,s=t.length,r=sl(e,s);Ce(n,r)||(i.uniform1iv(this.addr,r),Re(n,r));let o;this.type===i.SAMPLER_2D_SHADOW?o=rl(gp):o=mp;for(let a=0;a!==s;++a)e.setTexture2D(t[a]||o,r[a])}function ky(i,t,e){let n=this.cache,s=t.length,r=sl(e,s);Ce(n,r)||(i.uniform1iv(this.addr,r),Re(n,r));for(let o=0;o!==s;++o)e.setTexture3D(t[o]||vp,r[o])}function zy(i,t,e){let n=this.cache,s=t.length,r=sl(e,s);Ce(n,r)||(i.uniform1iv(this.addr,r),Re(n,r));let o;this.type===i.SAMPLER_CUBE_SHADOW?o=rl(_p):o=yp;for(let a=0;a!==s;++a)e.setTextureCube(t[a]||o,r[a])}function Gy(i,t,e){let n=this.cache,s=t.length,r=sl(e,s);Ce(n,r)||(i.uniform1iv(this.addr,r),Re(n,r));for(let o=0;o!==s;++o)e.setTexture2DArray(t[o]||xp,r[o])}function Vy(i){switch(i){case 5126:return Sy;case 35664:return wy;case 35665:return Ty;case 35666:return Ey;case 35674:return Ay;case 35675:return Cy;case 35676:return Ry;case 5124:case 35670:return Py;case 35667:case 35671:return Iy;case 35668:case 35672:return Ly;case 35669:case 35673:return Dy;case 5125:return Ny;case 36294:return Oy;case 36295:return Uy;case 36296:return Fy;case 35678:case 36198:case 36298:case 36306:case 35682:return By;case 35679:case 36299:case 36307:return ky;case 35680:case 36300:case 36308:case 36293:return zy;case 36289:case 36303:case 36311:case 36292:return Gy}}var Bh=class{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.setValue=by(e.type)}},kh=class{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=Vy(e.type)}},zh=class{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,n){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(t,e[a.id],n)}}},Uh=/(\w+)(\])?(\[|\.)?/g;function Qf(i,t){i.seq.push(t),i.map[t.id]=t}function Hy(i,t,e){let n=i.name,s=n.length;for(Uh.lastIndex=0;;){let r=Uh.exec(n),o=Uh.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){Qf(e,c===void 0?new Bh(a,i,t):new kh(a,i,t));break}else{let u=e.map[a];u===void 0&&(u=new zh(a),Qf(e,u)),e=u}}}var Ns=class{constructor(t,e){this.seq=[],this.map={};let n=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let o=0;o<n;++o){let a=t.getActiveUniform(e,o),l=t.getUniformLocation(e,a.name);Hy(a,l,this)}let s=[],r=[];for(let o of this.seq)o.type===t.SAMPLER_2D_SHADOW||o.type===t.SAMPLER_CUBE_SHADOW||o.type===t.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(t,e,n,s){let r=this.map[e];r!==void 0&&r.setValue(t,n,s)}setOptional(t,e,n){let s=e[n];s!==void 0&&this.setValue(t,n,s)}static upload(t,e,n,s){for(let r=0,o=e.length;r!==o;++r){let a=e[r],l=n[a.id];l.needsUpdate!==!1&&a.setValue(t,l.value,s)}}static seqWithValue(t,e){let n=[];for(let s=0,r=t.length;s!==r;++s){let o=t[s];o.id in e&&n.push(o)}return n}};function tp(i,t,e){let n=i.createShader(t);return i.shaderSource(n,e),i.compileShader(n),n}var Wy=37297,Xy=0;function qy(i,t){let e=i.split(`
`),n=[],s=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let o=s;o<r;o++){let a=o+1;n.push(`${a===t?">":" "} ${a}: ${e[o]}`)}return n.join(`
`)}var ep=new Ft;function $y(i){Kt._getMatrix(ep,Kt.workingColorSpace,i);let t=`mat3( ${ep.elements.map(e=>e.toFixed(4))} )`;switch(Kt.getTransfer(i)){case hr:return[t,"LinearTransferOETF"];case oe:return[t,"sRGBTransferOETF"];default:return Nt("WebGLProgram: Unsupported color space: ",i),[t,"LinearTransferOETF"]}}function np(i,t,e){let n=i.getShaderParameter(t,i.COMPILE_STATUS),r=(i.getShaderInfoLog(t)||"").trim();if(n&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return e.toUpperCase()+`

`+r+`

`+qy(i.getShaderSource(t),a)}else return r}function Yy(i,t){let e=$y(t);return[`vec4 ${i}( vec4 value ) {`,`	return ${e[1]}( vec4( ${e[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var Zy={[lh]:"Linear",[ch]:"Reinhard",[hh]:"Cineon",[uh]:"ACESFilmic",[fh]:"AgX",[ph]:"Neutral",[dh]:"Custom"};function Jy(i,t){let e=Zy[t];return e===void 0?(Nt("WebGLProgram: Unsupported toneMapping:",t),"vec3 "+i+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+i+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}var el=new O;function Ky(){Kt.getLuminanceCoefficients(el);let i=el.x.toFixed(4),t=el.y.toFixed(4),e=el.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function jy(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(kr).join(`
`)}function Qy(i){let t=[];for(let e in i){let n=i[e];n!==!1&&t.push("#define "+e+" "+n)}return t.join(`
`)}function tM(i,t){let e={},n=i.getProgramParameter(t,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){let r=i.getActiveAttrib(t,s),o=r.name,a=1;r.type===i.FLOAT_MAT2&&(a=2),r.type===i.FLOAT_MAT3&&(a=3),r.type===i.FLOAT_MAT4&&(a=4),e[o]={type:r.type,location:i.getAttribLocation(t,o),locationSize:a}}return e}function kr(i){return i!==""}function ip(i,t){let e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return i.replace(/NUM_SUN_LIGHTS/g,t.numSunLights).replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,t.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,t.numLightProbeGrids)}function sp(i,t){return i.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}var eM=/^[ \t]*#include +<([\w\d./]+)>/gm;function Gh(i){return i.replace(eM,nM)}function nM(i,t){let e=Xt[t];if(e===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+t+">");return Gh(e)}var iM=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function rp(i){return i.replace(iM,sM)}function sM(i,t,e,n){let s="";for(let r=parseInt(t);r<parseInt(e);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function op(i){let t=`precision ${i.precision} float;
	precision ${i.precision} int;
	precision ${i.precision} sampler2D;
	precision ${i.precision} samplerCube;
	precision ${i.precision} sampler3D;
	precision ${i.precision} sampler2DArray;
	precision ${i.precision} sampler2DShadow;
	precision ${i.precision} samplerCubeShadow;
	precision ${i.precision} sampler2DArrayShadow;
	precision ${i.precision} isampler2D;
	precision ${i.precision} isampler3D;
	precision ${i.precision} isamplerCube;
	precision ${i.precision} isampler2DArray;
	precision ${i.precision} usampler2D;
	precision ${i.precision} usampler3D;
	precision ${i.precision} usamplerCube;
	precision ${i.precision} usampler2DArray;
	`;return i.precision==="highp"?t+=`
#define HIGH_PRECISION`:i.precision==="mediump"?t+=`
#define MEDIUM_PRECISION`:i.precision==="lowp"&&(t+=`
#define LOW_PRECISION`),t}var rM={[Pr]:"SHADOWMAP_TYPE_PCF",[Rs]:"SHADOWMAP_TYPE_VSM"};function oM(i){return rM[i.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var aM={[Is]:"ENVMAP_MODE_REFRACTION"};function lM(i){return i.envMap===!1?"ENVMAP_MODE_REFLECTION":aM[i.envMapMode]||"ENVMAP_MODE_REFLECTION"}var cM={[ah]:"ENVMAP_BLENDING_MULTIPLY",[xf]:"ENVMAP_BLENDING_MIX",[vf]:"ENVMAP_BLENDING_ADD"};function hM(i){return i.envMap===!1?"ENVMAP_BLENDING_NONE":cM[i.combine]||"ENVMAP_BLENDING_NONE"}function uM(i,t,e,n){let s=i.getContext(),r=e.defines,o=e.vertexShader,a=e.fragmentShader,l=oM(e),c=e.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=lM(e),u=hM(e),d=jy(e),f=Qy(r),m=s.createProgram(),x,p,g=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(x=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f].filter(kr).join(`
`),x.length>0&&(x+=`
`),p=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f].filter(kr).join(`
`),p.length>0&&(p+=`
`)):(x=[op(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+h:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+e.diffuseRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexNormals?"#define HAS_NORMAL":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(kr).join(`
`),p=[op(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+c:"",e.envMap?"#define "+h:"",e.envMap?"#define "+u:"",e.envMapPMREM?"#define ENVMAP_MAX_LOD "+e.envMapMaxLod+".0":"",e.envMapPMREM?"#define ENVMAP_SIZE "+e.envMapSize+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.retroreflection?"#define USE_RETROREFLECTION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor?"#define USE_COLOR":"",e.vertexAlphas||e.batchingColor?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==qn?"#define TONE_MAPPING":"",e.toneMapping!==qn?Xt.tonemapping_pars_fragment:"",e.toneMapping!==qn?Jy("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",Xt.colorspace_pars_fragment,Yy("linearToOutputTexel",e.outputColorSpace),Ky(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(kr).join(`
`)),o=Gh(o),o=ip(o,e),o=sp(o,e),a=Gh(a),a=ip(a,e),a=sp(a,e),o=rp(o),a=rp(a),e.isRawShaderMaterial!==!0&&(g=`#version 300 es
`,x=[d,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+x,p=["#define varying in",e.glslVersion===di?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===di?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+p);let S=g+x+o,w=g+p+a,b=tp(s,s.VERTEX_SHADER,S),C=tp(s,s.FRAGMENT_SHADER,w);s.attachShader(m,b),s.attachShader(m,C),e.index0AttributeName!==void 0?s.bindAttribLocation(m,0,e.index0AttributeName):e.hasPositionAttribute===!0&&s.bindAttribLocation(m,0,"position"),s.linkProgram(m);function A(L){if(i.debug.checkShaderErrors){let N=s.getProgramInfoLog(m)||"",z=s.getShaderInfoLog(b)||"",Y=s.getShaderInfoLog(C)||"",I=N.trim(),X=z.trim(),$=Y.trim(),V=!0,it=!0;if(s.getProgramParameter(m,s.LINK_STATUS)===!1)if(V=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,m,b,C);else{let W=np(s,b,"vertex"),tt=np(s,C,"fragment");Ot("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(m,s.VALIDATE_STATUS)+`

Material Name: `+L.name+`
Material Type: `+L.type+`

Program Info Log: `+I+`
`+W+`
`+tt)}else I!==""?Nt("WebGLProgram: Program Info Log:",I):(X===""||$==="")&&(it=!1);it&&(L.diagnostics={runnable:V,programLog:I,vertexShader:{log:X,prefix:x},fragmentShader:{log:$,prefix:p}})}s.deleteShader(b),s.deleteShader(C),_=new Ns(s,m),T=tM(s,m)}let _;this.getUniforms=function(){return _===void 0&&A(this),_};let T;this.getAttributes=function(){return T===void 0&&A(this),T};let F=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return F===!1&&(F=s.getProgramParameter(m,Wy)),F},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(m),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=Xy++,this.cacheKey=t,this.usedTimes=1,this.program=m,this.vertexShader=b,this.fragmentShader=C,this}var dM=0,Vh=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t,e,n){let s=this._getShaderCacheForMaterial(t);return s.has(e)===!1&&(s.add(e),e.usedTimes++),s.has(n)===!1&&(s.add(n),n.usedTimes++),this}remove(t){let e=this.materialCache.get(t);for(let n of e)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(t),this}getVertexShaderStage(t){return this._getShaderStage(t.vertexShader)}getFragmentShaderStage(t){return this._getShaderStage(t.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){let e=this.materialCache,n=e.get(t);return n===void 0&&(n=new Set,e.set(t,n)),n}_getShaderStage(t){let e=this.shaderCache,n=e.get(t);return n===void 0&&(n=new Hh(t),e.set(t,n)),n}},Hh=class{constructor(t){this.id=dM++,this.code=t,this.usedTimes=0}};function fM(i){return i===Ni||i===Ur||i===Fr}function pM(i,t,e,n,s,r){let o=new Ss,a=new Vh,l=new Set,c=[],h=new Map,u=n.logarithmicDepthBuffer,d={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function f(_){return l.add(_),_===0?"uv":`uv${_}`}function m(_,T,F,L,N,z){let Y=L.fog,I=N.geometry,X=_.isMeshStandardMaterial||_.isMeshLambertMaterial||_.isMeshPhongMaterial?L.environment:null,$=_.isMeshStandardMaterial||_.isMeshLambertMaterial&&!_.envMap||_.isMeshPhongMaterial&&!_.envMap,V=t.get(_.envMap||X,$),it=d[_.type],W=n.precision;_.precision!==null&&(W=n.getMaxPrecision(_.precision),W!==_.precision&&Nt("WebGLProgram.getParameters:",_.precision,"not supported, using",W,"instead."));let tt=I.morphAttributes.position||I.morphAttributes.normal||I.morphAttributes.color,et=tt!==void 0?tt.length:0,Mt=0;I.morphAttributes.position!==void 0&&(Mt=1),I.morphAttributes.normal!==void 0&&(Mt=2),I.morphAttributes.color!==void 0&&(Mt=3);let It,J,pt,yt;if(it){let _t=Yn[it];It=_t.vertexShader,J=_t.fragmentShader}else{It=_.vertexShader,J=_.fragmentShader;let _t=a.getVertexShaderStage(_),ae=a.getFragmentShaderStage(_);a.update(_,_t,ae),pt=_t.id,yt=ae.id}let Ct=i.getRenderTarget(),gt=i.state.buffers.depth.getReversed(),Ut=N.isInstancedMesh===!0,xe=N.isBatchedMesh===!0,Pt=!!_.map,te=!!_.matcap,re=!!V,Yt=re&&V.isPMREMTexture===!0,Ue=!!_.aoMap,Ee=!!_.lightMap,je=!!_.bumpMap&&_.wireframe===!1,pe=!!_.normalMap,Bn=!!_.displacementMap,Ie=!!_.emissiveMap,gn=!!_.metalnessMap,_n=!!_.roughnessMap,xn=_.anisotropy>0,D=_.clearcoat>0,vn=_.diffuseRoughness>0,de=_.dispersion>0,fe=_.retroreflectivity>0,mt=_.iridescence>0,Ae=_.sheen>0,Lt=_.transmission>0,kt=xn&&!!_.anisotropyMap,E=D&&!!_.clearcoatMap,v=D&&!!_.clearcoatNormalMap,B=D&&!!_.clearcoatRoughnessMap,st=vn&&!!_.diffuseRoughnessMap,Q=mt&&!!_.iridescenceMap,at=mt&&!!_.iridescenceThicknessMap,dt=Ae&&!!_.sheenColorMap,Z=Ae&&!!_.sheenRoughnessMap,K=!!_.specularMap,ct=!!_.specularColorMap,R=!!_.specularIntensityMap,j=Lt&&!!_.transmissionMap,q=Lt&&!!_.thicknessMap,ht=!!_.gradientMap,ot=!!_.alphaMap,lt=_.alphaTest>0,At=!!_.alphaHash,Wt=!!_.extensions,rt=qn;_.toneMapped&&(Ct===null||Ct.isXRRenderTarget===!0)&&(rt=i.toneMapping);let Rt=Yt?V.isCompressedCubeTexture?V.image[0].mipmaps:V.mipmaps:null,Ht={shaderID:it,shaderType:_.type,shaderName:_.name,vertexShader:It,fragmentShader:J,defines:_.defines,customVertexShaderID:pt,customFragmentShaderID:yt,isRawShaderMaterial:_.isRawShaderMaterial===!0,glslVersion:_.glslVersion,precision:W,batching:xe,batchingColor:xe&&N._colorsTexture!==null,instancing:Ut,instancingColor:Ut&&N.instanceColor!==null,instancingMorph:Ut&&N.morphTexture!==null,outputColorSpace:Ct===null?i.outputColorSpace:Ct.isXRRenderTarget===!0?Ct.texture.colorSpace:Kt.workingColorSpace,alphaToCoverage:!!_.alphaToCoverage,map:Pt,matcap:te,envMap:re,envMapMode:re&&V.mapping,envMapPMREM:Yt,envMapMaxLod:Yt?Rt.length-1:null,envMapSize:Yt?Rt[0].width:null,aoMap:Ue,lightMap:Ee,bumpMap:je,normalMap:pe,displacementMap:Bn,emissiveMap:Ie,normalMapObjectSpace:pe&&_.normalMapType===bf,normalMapTangentSpace:pe&&_.normalMapType===Sh,packedNormalMap:pe&&_.normalMapType===Sh&&fM(_.normalMap.format),metalnessMap:gn,roughnessMap:_n,anisotropy:xn,anisotropyMap:kt,clearcoat:D,clearcoatMap:E,clearcoatNormalMap:v,clearcoatRoughnessMap:B,diffuseRoughness:vn,diffuseRoughnessMap:st,dispersion:de,retroreflection:fe,iridescence:mt,iridescenceMap:Q,iridescenceThicknessMap:at,sheen:Ae,sheenColorMap:dt,sheenRoughnessMap:Z,specularMap:K,specularColorMap:ct,specularIntensityMap:R,transmission:Lt,transmissionMap:j,thicknessMap:q,gradientMap:ht,opaque:_.transparent===!1&&_.blending===Ps&&_.alphaToCoverage===!1,alphaMap:ot,alphaTest:lt,alphaHash:At,combine:_.combine,mapUv:Pt&&f(_.map.channel),aoMapUv:Ue&&f(_.aoMap.channel),lightMapUv:Ee&&f(_.lightMap.channel),bumpMapUv:je&&f(_.bumpMap.channel),normalMapUv:pe&&f(_.normalMap.channel),displacementMapUv:Bn&&f(_.displacementMap.channel),emissiveMapUv:Ie&&f(_.emissiveMap.channel),metalnessMapUv:gn&&f(_.metalnessMap.channel),roughnessMapUv:_n&&f(_.roughnessMap.channel),anisotropyMapUv:kt&&f(_.anisotropyMap.channel),clearcoatMapUv:E&&f(_.clearcoatMap.channel),clearcoatNormalMapUv:v&&f(_.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:B&&f(_.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:st&&f(_.diffuseRoughnessMap.channel),iridescenceMapUv:Q&&f(_.iridescenceMap.channel),iridescenceThicknessMapUv:at&&f(_.iridescenceThicknessMap.channel),sheenColorMapUv:dt&&f(_.sheenColorMap.channel),sheenRoughnessMapUv:Z&&f(_.sheenRoughnessMap.channel),specularMapUv:K&&f(_.specularMap.channel),specularColorMapUv:ct&&f(_.specularColorMap.channel),specularIntensityMapUv:R&&f(_.specularIntensityMap.channel),transmissionMapUv:j&&f(_.transmissionMap.channel),thicknessMapUv:q&&f(_.thicknessMap.channel),alphaMapUv:ot&&f(_.alphaMap.channel),vertexTangents:!!I.attributes.tangent&&(pe||xn),vertexNormals:!!I.attributes.normal,vertexColors:_.vertexColors,vertexAlphas:_.vertexColors===!0&&!!I.attributes.color&&I.attributes.color.itemSize===4,pointsUvs:N.isPoints===!0&&!!I.attributes.uv&&(Pt||ot),fog:!!Y,useFog:_.fog===!0,fogExp2:!!Y&&Y.isFogExp2,flatShading:_.wireframe===!1&&(_.flatShading===!0||I.attributes.normal===void 0&&pe===!1&&(_.isMeshLambertMaterial||_.isMeshPhongMaterial||_.isMeshStandardMaterial||_.isMeshPhysicalMaterial)),sizeAttenuation:_.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:gt,skinning:N.isSkinnedMesh===!0,hasPositionAttribute:I.attributes.position!==void 0,morphTargets:I.morphAttributes.position!==void 0,morphNormals:I.morphAttributes.normal!==void 0,morphColors:I.morphAttributes.color!==void 0,morphTargetsCount:et,morphTextureStride:Mt,numSunLights:T.sun.length,numDirLights:T.directional.length,numPointLights:T.point.length,numSpotLights:T.spot.length,numSpotLightMaps:T.spotLightMap.length,numRectAreaLights:T.rectArea.length,numHemiLights:T.hemi.length,numSunLightShadows:T.sunShadowMap.length,numDirLightShadows:T.directionalShadowMap.length,numPointLightShadows:T.pointShadowMap.length,numSpotLightShadows:T.spotShadowMap.length,numSpotLightShadowsWithMaps:T.numSpotLightShadowsWithMaps,numLightProbes:T.numLightProbes,numLightProbeGrids:z.filter(_t=>_t.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:_.dithering,shadowMapEnabled:i.shadowMap.enabled&&F.length>0,shadowMapType:i.shadowMap.type,toneMapping:rt,decodeVideoTexture:Pt&&_.map.isVideoTexture===!0&&Kt.getTransfer(_.map.colorSpace)===oe,decodeVideoTextureEmissive:Ie&&_.emissiveMap.isVideoTexture===!0&&Kt.getTransfer(_.emissiveMap.colorSpace)===oe,premultipliedAlpha:_.premultipliedAlpha,doubleSided:_.side===Xn,flipSided:_.side===Be,useDepthPacking:_.depthPacking>=0,depthPacking:_.depthPacking||0,index0AttributeName:_.index0AttributeName,extensionClipCullDistance:Wt&&_.extensions.clipCullDistance===!0&&e.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Wt&&_.extensions.multiDraw===!0||xe)&&e.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:e.has("KHR_parallel_shader_compile"),customProgramCacheKey:_.customProgramCacheKey()};return Ht.vertexUv1s=l.has(1),Ht.vertexUv2s=l.has(2),Ht.vertexUv3s=l.has(3),l.clear(),Ht}function x(_){let T=[];if(_.shaderID?T.push(_.shaderID):(T.push(_.customVertexShaderID),T.push(_.customFragmentShaderID)),_.defines!==void 0)for(let F in _.defines)T.push(F),T.push(_.defines[F]);return _.isRawShaderMaterial===!1&&(p(T,_),g(T,_),T.push(i.outputColorSpace)),T.push(_.customProgramCacheKey),T.join()}function p(_,T){_.push(T.precision),_.push(T.outputColorSpace),_.push(T.envMapMode),_.push(T.envMapPMREM),_.push(T.envMapMaxLod),_.push(T.envMapSize),_.push(T.mapUv),_.push(T.alphaMapUv),_.push(T.lightMapUv),_.push(T.aoMapUv),_.push(T.bumpMapUv),_.push(T.normalMapUv),_.push(T.displacementMapUv),_.push(T.emissiveMapUv),_.push(T.metalnessMapUv),_.push(T.roughnessMapUv),_.push(T.anisotropyMapUv),_.push(T.clearcoatMapUv),_.push(T.clearcoatNormalMapUv),_.push(T.clearcoatRoughnessMapUv),_.push(T.diffuseRoughnessMapUv),_.push(T.iridescenceMapUv),_.push(T.iridescenceThicknessMapUv),_.push(T.sheenColorMapUv),_.push(T.sheenRoughnessMapUv),_.push(T.specularMapUv),_.push(T.specularColorMapUv),_.push(T.specularIntensityMapUv),_.push(T.transmissionMapUv),_.push(T.thicknessMapUv),_.push(T.combine),_.push(T.fogExp2),_.push(T.sizeAttenuation),_.push(T.morphTargetsCount),_.push(T.numSunLights),_.push(T.numDirLights),_.push(T.numPointLights),_.push(T.numSpotLights),_.push(T.numSpotLightMaps),_.push(T.numHemiLights),_.push(T.numRectAreaLights),_.push(T.numSunLightShadows),_.push(T.numDirLightShadows),_.push(T.numPointLightShadows),_.push(T.numSpotLightShadows),_.push(T.numSpotLightShadowsWithMaps),_.push(T.numLightProbes),_.push(T.numLightProbeGrids),_.push(T.shadowMapType),_.push(T.toneMapping),_.push(T.numClippingPlanes),_.push(T.numClipIntersection),_.push(T.depthPacking)}function g(_,T){o.disableAll(),T.instancing&&o.enable(0),T.instancingColor&&o.enable(1),T.instancingMorph&&o.enable(2),T.matcap&&o.enable(3),T.envMap&&o.enable(4),T.normalMapObjectSpace&&o.enable(5),T.normalMapTangentSpace&&o.enable(6),T.clearcoat&&o.enable(7),T.iridescence&&o.enable(8),T.alphaTest&&o.enable(9),T.vertexColors&&o.enable(10),T.vertexAlphas&&o.enable(11),T.vertexUv1s&&o.enable(12),T.vertexUv2s&&o.enable(13),T.vertexUv3s&&o.enable(14),T.vertexTangents&&o.enable(15),T.anisotropy&&o.enable(16),T.alphaHash&&o.enable(17),T.batching&&o.enable(18),T.dispersion&&o.enable(19),T.retroreflection&&o.enable(24),T.diffuseRoughness&&o.enable(25),T.batchingColor&&o.enable(20),T.gradientMap&&o.enable(21),T.packedNormalMap&&o.enable(22),T.vertexNormals&&o.enable(23),_.push(o.mask),o.disableAll(),T.fog&&o.enable(0),T.useFog&&o.enable(1),T.flatShading&&o.enable(2),T.logarithmicDepthBuffer&&o.enable(3),T.reversedDepthBuffer&&o.enable(4),T.skinning&&o.enable(5),T.morphTargets&&o.enable(6),T.morphNormals&&o.enable(7),T.morphColors&&o.enable(8),T.premultipliedAlpha&&o.enable(9),T.shadowMapEnabled&&o.enable(10),T.doubleSided&&o.enable(11),T.flipSided&&o.enable(12),T.useDepthPacking&&o.enable(13),T.dithering&&o.enable(14),T.transmission&&o.enable(15),T.sheen&&o.enable(16),T.opaque&&o.enable(17),T.pointsUvs&&o.enable(18),T.decodeVideoTexture&&o.enable(19),T.decodeVideoTextureEmissive&&o.enable(20),T.alphaToCoverage&&o.enable(21),T.numLightProbeGrids>0&&o.enable(22),T.hasPositionAttribute&&o.enable(23),_.push(o.mask)}function S(_){let T=d[_.type],F;if(T){let L=Yn[T];F=Gf.clone(L.uniforms)}else F=_.uniforms;return F}function w(_,T){let F=h.get(T);return F!==void 0?++F.usedTimes:(F=new uM(i,T,_,s),c.push(F),h.set(T,F)),F}function b(_){if(--_.usedTimes===0){let T=c.indexOf(_);c[T]=c[c.length-1],c.pop(),h.delete(_.cacheKey),_.destroy()}}function C(_){a.remove(_)}function A(){a.dispose()}return{getParameters:m,getProgramCacheKey:x,getUniforms:S,acquireProgram:w,releaseProgram:b,releaseShaderCache:C,programs:c,dispose:A}}function mM(){let i=new WeakMap;function t(o){return i.has(o)}function e(o){let a=i.get(o);return a===void 0&&(a={},i.set(o,a)),a}function n(o){i.delete(o)}function s(o,a,l){i.get(o)[a]=l}function r(){i=new WeakMap}return{has:t,get:e,remove:n,update:s,dispose:r}}function gM(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.material.id!==t.material.id?i.material.id-t.material.id:i.materialVariant!==t.materialVariant?i.materialVariant-t.materialVariant:i.z!==t.z?i.z-t.z:i.id-t.id}function ap(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.z!==t.z?t.z-i.z:i.id-t.id}function lp(){let i=[],t=0,e=[],n=[],s=[];function r(){t=0,e.length=0,n.length=0,s.length=0}function o(d){let f=0;return d.isInstancedMesh&&(f+=2),d.isSkinnedMesh&&(f+=1),f}function a(d,f,m,x,p,g){let S=i[t];return S===void 0?(S={id:d.id,object:d,geometry:f,material:m,materialVariant:o(d),groupOrder:x,renderOrder:d.renderOrder,z:p,group:g},i[t]=S):(S.id=d.id,S.object=d,S.geometry=f,S.material=m,S.materialVariant=o(d),S.groupOrder=x,S.renderOrder=d.renderOrder,S.z=p,S.group=g),t++,S}function l(d,f,m,x,p,g,S){S.reversedDepth===!0&&(p=-p);let w=a(d,f,m,x,p,g);m.transmission>0?n.push(w):m.transparent===!0?s.push(w):e.push(w)}function c(d,f,m,x,p,g){let S=a(d,f,m,x,p,g);m.transmission>0?n.unshift(S):m.transparent===!0?s.unshift(S):e.unshift(S)}function h(d,f){e.length>1&&e.sort(d||gM),n.length>1&&n.sort(f||ap),s.length>1&&s.sort(f||ap)}function u(){for(let d=t,f=i.length;d<f;d++){let m=i[d];if(m.id===null)break;m.id=null,m.object=null,m.geometry=null,m.material=null,m.group=null}}return{opaque:e,transmissive:n,transparent:s,init:r,push:l,unshift:c,finish:u,sort:h}}function _M(){let i=new WeakMap;function t(n,s){let r=i.get(n),o;return r===void 0?(o=new lp,i.set(n,[o])):s>=r.length?(o=new lp,r.push(o)):o=r[s],o}function e(){i=new WeakMap}return{get:t,dispose:e}}function xM(){let i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={direction:new O,color:new Bt};break;case"SpotLight":e={position:new O,direction:new O,color:new Bt,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new O,color:new Bt,distance:0,decay:0};break;case"HemisphereLight":e={direction:new O,skyColor:new Bt,groundColor:new Bt};break;case"RectAreaLight":e={color:new Bt,position:new O,halfWidth:new O,halfHeight:new O};break}return i[t.id]=e,e}}}function vM(){let i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Dt};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Dt};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Dt,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[t.id]=e,e}}}var yM=0;function MM(i,t){return(t.castShadow?2:0)-(i.castShadow?2:0)+(t.map?1:0)-(i.map?1:0)}function bM(i){let t=new xM,e=vM(),n={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new O);let s=new O,r=new Qt,o=new Qt;function a(c){let h=0,u=0,d=0;for(let z=0;z<9;z++)n.probe[z].set(0,0,0);let f=0,m=0,x=0,p=0,g=0,S=0,w=0,b=0,C=0,A=0,_=0,T=0,F=0,L=0;c.sort(MM);for(let z=0,Y=c.length;z<Y;z++){let I=c[z],X=I.color,$=I.intensity,V=I.distance,it=null;if(I.shadow&&I.shadow.map&&(I.shadow.map.texture.format===Ni?it=I.shadow.map.texture:it=I.shadow.map.depthTexture||I.shadow.map.texture),I.isAmbientLight)h+=X.r*$,u+=X.g*$,d+=X.b*$;else if(I.isLightProbe){for(let W=0;W<9;W++)n.probe[W].addScaledVector(I.sh.coefficients[W],$);L++}else if(I.isSunLight){let W=t.get(I);if(W.color.copy(I.color).multiplyScalar(I.intensity),I.castShadow){let tt=I.shadow,et=e.get(I);et.shadowIntensity=tt.intensity,et.shadowBias=tt.bias,et.shadowNormalBias=tt.normalBias,et.shadowRadius=tt.radius,et.shadowMapSize.copy(tt.mapSize).multiply(tt.getFrameExtents()),n.sunShadow[m]=et,n.sunShadowMap[m]=it;let Mt=tt.getViewportCount();for(let It=0;It<Mt;It++)n.sunShadowMatrix[x+It]=tt.getMatrix(It),n.sunShadowCascade[x+It]=tt._cascadeData[It];x+=Mt,m++}n.sun[f]=W,f++}else if(I.isDirectionalLight){let W=t.get(I);if(W.color.copy(I.color).multiplyScalar(I.intensity),I.castShadow){let tt=I.shadow,et=e.get(I);et.shadowIntensity=tt.intensity,et.shadowBias=tt.bias,et.shadowNormalBias=tt.normalBias,et.shadowRadius=tt.radius,et.shadowMapSize=tt.mapSize,n.directionalShadow[p]=et,n.directionalShadowMap[p]=it,n.directionalShadowMatrix[p]=I.shadow.matrix,C++}n.directional[p]=W,p++}else if(I.isSpotLight){let W=t.get(I);W.position.setFromMatrixPosition(I.matrixWorld),W.color.copy(X).multiplyScalar($),W.distance=V,W.coneCos=Math.cos(I.angle),W.penumbraCos=Math.cos(I.angle*(1-I.penumbra)),W.decay=I.decay,n.spot[S]=W;let tt=I.shadow;if(I.map&&(n.spotLightMap[T]=I.map,T++,tt.updateMatrices(I),I.castShadow&&F++),n.spotLightMatrix[S]=tt.matrix,I.castShadow){let et=e.get(I);et.shadowIntensity=tt.intensity,et.shadowBias=tt.bias,et.shadowNormalBias=tt.normalBias,et.shadowRadius=tt.radius,et.shadowMapSize=tt.mapSize,n.spotShadow[S]=et,n.spotShadowMap[S]=it,_++}S++}else if(I.isRectAreaLight){let W=t.get(I);W.color.copy(X).multiplyScalar($),W.halfWidth.set(I.width*.5,0,0),W.halfHeight.set(0,I.height*.5,0),n.rectArea[w]=W,w++}else if(I.isPointLight){let W=t.get(I);if(W.color.copy(I.color).multiplyScalar(I.intensity),W.distance=I.distance,W.decay=I.decay,I.castShadow){let tt=I.shadow,et=e.get(I);et.shadowIntensity=tt.intensity,et.shadowBias=tt.bias,et.shadowNormalBias=tt.normalBias,et.shadowRadius=tt.radius,et.shadowMapSize=tt.mapSize,et.shadowCameraNear=tt.camera.near,et.shadowCameraFar=tt.camera.far,n.pointShadow[g]=et,n.pointShadowMap[g]=it,n.pointShadowMatrix[g]=I.shadow.matrix,A++}n.point[g]=W,g++}else if(I.isHemisphereLight){let W=t.get(I);W.skyColor.copy(I.color).multiplyScalar($),W.groundColor.copy(I.groundColor).multiplyScalar($),n.hemi[b]=W,b++}}w>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=xt.LTC_FLOAT_1,n.rectAreaLTC2=xt.LTC_FLOAT_2):(n.rectAreaLTC1=xt.LTC_HALF_1,n.rectAreaLTC2=xt.LTC_HALF_2)),n.ambient[0]=h,n.ambient[1]=u,n.ambient[2]=d;let N=n.hash;(N.sunLength!==f||N.directionalLength!==p||N.pointLength!==g||N.spotLength!==S||N.rectAreaLength!==w||N.hemiLength!==b||N.numSunShadows!==m||N.numDirectionalShadows!==C||N.numPointShadows!==A||N.numSpotShadows!==_||N.numSpotMaps!==T||N.numLightProbes!==L)&&(n.sun.length=f,n.directional.length=p,n.spot.length=S,n.rectArea.length=w,n.point.length=g,n.hemi.length=b,n.sunShadow.length=m,n.sunShadowMap.length=m,n.sunShadowMatrix.length=x,n.sunShadowCascade.length=x,n.directionalShadow.length=C,n.directionalShadowMap.length=C,n.directionalShadowMatrix.length=C,n.pointShadow.length=A,n.pointShadowMap.length=A,n.pointShadowMatrix.length=A,n.spotShadow.length=_,n.spotShadowMap.length=_,n.spotLightMatrix.length=_+T-F,n.spotLightMap.length=T,n.numSpotLightShadowsWithMaps=F,n.numLightProbes=L,N.sunLength=f,N.directionalLength=p,N.pointLength=g,N.spotLength=S,N.rectAreaLength=w,N.hemiLength=b,N.numSunShadows=m,N.numDirectionalShadows=C,N.numPointShadows=A,N.numSpotShadows=_,N.numSpotMaps=T,N.numLightProbes=L,n.version=yM++)}function l(c,h){let u=0,d=0,f=0,m=0,x=0,p=0,g=h.matrixWorldInverse;for(let S=0,w=c.length;S<w;S++){let b=c[S];if(b.isSunLight){let C=n.sun[u];C.direction.setFromMatrixPosition(b.matrixWorld),C.direction.transformDirection(g),u++}else if(b.isDirectionalLight){let C=n.directional[d];C.direction.setFromMatrixPosition(b.matrixWorld),s.setFromMatrixPosition(b.target.matrixWorld),C.direction.sub(s),C.direction.transformDirection(g),d++}else if(b.isSpotLight){let C=n.spot[m];C.position.setFromMatrixPosition(b.matrixWorld),C.position.applyMatrix4(g),C.direction.setFromMatrixPosition(b.matrixWorld),s.setFromMatrixPosition(b.target.matrixWorld),C.direction.sub(s),C.direction.transformDirection(g),m++}else if(b.isRectAreaLight){let C=n.rectArea[x];C.position.setFromMatrixPosition(b.matrixWorld),C.position.applyMatrix4(g),o.identity(),r.copy(b.matrixWorld),r.premultiply(g),o.extractRotation(r),C.halfWidth.set(b.width*.5,0,0),C.halfHeight.set(0,b.height*.5,0),C.halfWidth.applyMatrix4(o),C.halfHeight.applyMatrix4(o),x++}else if(b.isPointLight){let C=n.point[f];C.position.setFromMatrixPosition(b.matrixWorld),C.position.applyMatrix4(g),f++}else if(b.isHemisphereLight){let C=n.hemi[p];C.direction.setFromMatrixPosition(b.matrixWorld),C.direction.transformDirection(g),p++}}}return{setup:a,setupView:l,state:n}}function cp(i){let t=new bM(i),e=[],n=[],s=[];function r(u){h.camera=u,e.length=0,n.length=0,s.length=0}function o(u){u.isLightProbeGrid?s.push(u):e.push(u)}function a(u){n.push(u)}function l(){t.setup(e),s.sort((u,d)=>u.priority-d.priority||u.id-d.id)}function c(u){t.setupView(e,u)}let h={lightsArray:e,shadowsArray:n,lightProbeGridArray:s,camera:null,lights:t,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function SM(i){let t=new WeakMap;function e(s,r=0){let o=t.get(s),a;return o===void 0?(a=new cp(i),t.set(s,[a])):r>=o.length?(a=new cp(i),o.push(a)):a=o[r],a}function n(){t=new WeakMap}return{get:e,dispose:n}}var wM=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,TM=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,EM=[new O(1,0,0),new O(-1,0,0),new O(0,1,0),new O(0,-1,0),new O(0,0,1),new O(0,0,-1)],AM=[new O(0,-1,0),new O(0,-1,0),new O(0,0,1),new O(0,0,-1),new O(0,-1,0),new O(0,-1,0)],hp=new Qt,Br=new O,Fh=new O;function CM(i,t,e){let n=new qi,s=new Dt,r=new Dt,o=new _e,a=new ea,l=new na,c={},h=e.maxTextureSize,u={[Di]:Be,[Be]:Di,[Xn]:Xn},d=new Hn({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new Dt},radius:{value:4}},vertexShader:wM,fragmentShader:TM}),f=d.clone();f.defines.HORIZONTAL_PASS=1;let m=new tn;m.setAttribute("position",new Te(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let x=new en(m,d),p=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Pr;let g=this.type;this.render=function(A,_,T){if(p.enabled===!1||p.autoUpdate===!1&&p.needsUpdate===!1||A.length===0)return;this.type===jd&&(Nt("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=Pr);let F=i.getRenderTarget(),L=i.getActiveCubeFace(),N=i.getActiveMipmapLevel(),z=i.state;z.setBlending(Yi),z.buffers.depth.getReversed()===!0?z.buffers.color.setClear(0,0,0,0):z.buffers.color.setClear(1,1,1,1),z.buffers.depth.setTest(!0),z.setScissorTest(!1);let Y=g!==this.type;Y&&_.traverse(function(I){I.material&&(Array.isArray(I.material)?I.material.forEach(X=>X.needsUpdate=!0):I.material.needsUpdate=!0)});for(let I=0,X=A.length;I<X;I++){let $=A[I],V=$.shadow;if(V===void 0){Nt("WebGLShadowMap:",$,"has no shadow.");continue}if(V.autoUpdate===!1&&V.needsUpdate===!1)continue;s.copy(V.mapSize);let it=V.getFrameExtents();s.multiply(it),r.copy(V.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/it.x),s.x=r.x*it.x,V.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/it.y),s.y=r.y*it.y,V.mapSize.y=r.y));let W=i.state.buffers.depth.getReversed();if(V.camera._reversedDepth=W,V.map===null||Y===!0){if(V.map!==null&&(V.map.depthTexture!==null&&(V.map.depthTexture.dispose(),V.map.depthTexture=null),V.map.dispose()),this.type===Rs){if($.isPointLight){Nt("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}V.map=new hn(s.x,s.y,{format:Ni,type:Dn,minFilter:Ze,magFilter:Ze,generateMipmaps:!1}),V.map.texture.name=$.name+".shadowMap",V.map.depthTexture=new li(s.x,s.y,pn),V.map.depthTexture.name=$.name+".shadowMapDepth",V.map.depthTexture.format=ai,V.map.depthTexture.compareFunction=null,V.map.depthTexture.minFilter=ve,V.map.depthTexture.magFilter=ve}else $.isPointLight?(V.map=new zr(s.x),V.map.depthTexture=new vr(s.x,Ln)):(V.map=new hn(s.x,s.y),V.map.depthTexture=new li(s.x,s.y,Ln)),V.map.depthTexture.name=$.name+".shadowMap",V.map.depthTexture.format=ai,this.type===Pr?(V.map.depthTexture.compareFunction=W?Th:wh,V.map.depthTexture.minFilter=Ze,V.map.depthTexture.magFilter=Ze):(V.map.depthTexture.compareFunction=null,V.map.depthTexture.minFilter=ve,V.map.depthTexture.magFilter=ve);V.camera.updateProjectionMatrix()}V.map.isWebGLCubeRenderTarget!==!0&&(V.map.width!==s.x||V.map.height!==s.y)&&V.map.setSize(s.x,s.y);let tt=V.map.isWebGLCubeRenderTarget?6:V.getViewportCount();$.isPointLight!==!0&&V.updateMatrices($,T);let et=(V.camera.layers.mask&4294967294)!==0?V.camera.layers:T.layers;for(let Mt=0;Mt<tt;Mt++){let It=V.getCamera(Mt);if($.isPointLight){let J=V.camera,pt=V.matrix,yt=$.distance||J.far;yt!==J.far&&(J.far=yt,J.updateProjectionMatrix()),Br.setFromMatrixPosition($.matrixWorld),J.position.copy(Br),Fh.copy(J.position),Fh.add(EM[Mt]),J.up.copy(AM[Mt]),J.lookAt(Fh),J.updateMatrixWorld(),pt.makeTranslation(-Br.x,-Br.y,-Br.z),hp.multiplyMatrices(J.projectionMatrix,J.matrixWorldInverse),V._frustum.setFromProjectionMatrix(hp,J.coordinateSystem,J.reversedDepth)}if(V.map.isWebGLCubeRenderTarget)i.setRenderTarget(V.map,Mt),i.clear();else{Mt===0&&(i.setRenderTarget(V.map),i.clear());let J=V.getViewport(Mt);o.set(r.x*J.x,r.y*J.y,r.x*J.z,r.y*J.w),z.viewport(o)}n=V.getFrustum(Mt),b(_,T,It,$,et,this.type)}V.isPointLightShadow!==!0&&this.type===Rs&&S(V,T),V.needsUpdate=!1}g=this.type,p.needsUpdate=!1,i.setRenderTarget(F,L,N)};function S(A,_){let T=t.update(x);d.defines.VSM_SAMPLES!==A.blurSamples&&(d.defines.VSM_SAMPLES=A.blurSamples,f.defines.VSM_SAMPLES=A.blurSamples,d.needsUpdate=!0,f.needsUpdate=!0),A.mapPass===null?A.mapPass=new hn(s.x,s.y,{format:Ni,type:Dn}):(A.mapPass.width!==A.map.width||A.mapPass.height!==A.map.height)&&A.mapPass.setSize(A.map.width,A.map.height),d.uniforms.shadow_pass.value=A.map.depthTexture,d.uniforms.resolution.value.set(A.map.width,A.map.height),d.uniforms.radius.value=A.radius,i.setRenderTarget(A.mapPass),i.clear(),i.renderBufferDirect(_,null,T,d,x,null),f.uniforms.shadow_pass.value=A.mapPass.texture,f.uniforms.resolution.value.set(A.map.width,A.map.height),f.uniforms.radius.value=A.radius,i.setRenderTarget(A.map),i.clear(),i.renderBufferDirect(_,null,T,f,x,null)}function w(A,_,T,F){let L=null,N=T.isPointLight===!0?A.customDistanceMaterial:A.customDepthMaterial;if(N!==void 0)L=N;else if(L=T.isPointLight===!0?l:a,i.localClippingEnabled&&_.clipShadows===!0&&Array.isArray(_.clippingPlanes)&&_.clippingPlanes.length!==0||_.displacementMap&&_.displacementScale!==0||_.alphaMap&&_.alphaTest>0||_.map&&_.alphaTest>0||_.alphaToCoverage===!0){let z=L.uuid,Y=_.uuid,I=c[z];I===void 0&&(I={},c[z]=I);let X=I[Y];X===void 0&&(X=L.clone(),I[Y]=X,_.addEventListener("dispose",C)),L=X}if(L.visible=_.visible,L.wireframe=_.wireframe,F===Rs?L.side=_.shadowSide!==null?_.shadowSide:_.side:L.side=_.shadowSide!==null?_.shadowSide:u[_.side],L.alphaMap=_.alphaMap,L.alphaTest=_.alphaToCoverage===!0?.5:_.alphaTest,L.map=_.map,L.clipShadows=_.clipShadows,L.clippingPlanes=_.clippingPlanes,L.clipIntersection=_.clipIntersection,L.displacementMap=_.displacementMap,L.displacementScale=_.displacementScale,L.displacementBias=_.displacementBias,L.wireframeLinewidth=_.wireframeLinewidth,L.linewidth=_.linewidth,T.isPointLight===!0&&L.isMeshDistanceMaterial===!0){let z=i.properties.get(L);z.light=T}return L}function b(A,_,T,F,L,N){if(A.visible===!1)return;if(A.layers.test(L)&&(A.isMesh||A.isLine||A.isPoints)&&(A.castShadow||A.receiveShadow&&N===Rs)&&(!A.frustumCulled||A.intersectsFrustum(n))){A.modelViewMatrix.multiplyMatrices(T.matrixWorldInverse,A.matrixWorld);let I=t.update(A),X=A.material;if(Array.isArray(X)){let $=I.groups;for(let V=0,it=$.length;V<it;V++){let W=$[V],tt=X[W.materialIndex];if(tt&&tt.visible){let et=w(A,tt,F,N);A.onBeforeShadow(i,A,_,T,I,et,W),i.renderBufferDirect(T,null,I,et,A,W),A.onAfterShadow(i,A,_,T,I,et,W)}}}else if(X.visible){let $=w(A,X,F,N);A.onBeforeShadow(i,A,_,T,I,$,null),i.renderBufferDirect(T,null,I,$,A,null),A.onAfterShadow(i,A,_,T,I,$,null)}}let Y=A.children;for(let I=0,X=Y.length;I<X;I++)b(Y[I],_,T,F,L,N)}function C(A){A.target.removeEventListener("dispose",C);for(let T in c){let F=c[T],L=A.target.uuid;L in F&&(F[L].dispose(),delete F[L])}}}function RM(i,t){function e(){let R=!1,j=new _e,q=null,ht=new _e(0,0,0,0);return{setMask:function(ot){q!==ot&&!R&&(i.colorMask(ot,ot,ot,ot),q=ot)},setLocked:function(ot){R=ot},setClear:function(ot,lt,At,Wt,rt){rt===!0&&(ot*=Wt,lt*=Wt,At*=Wt),j.set(ot,lt,At,Wt),ht.equals(j)===!1&&(i.clearColor(ot,lt,At,Wt),ht.copy(j))},reset:function(){R=!1,q=null,ht.set(-1,0,0,0)}}}function n(){let R=!1,j=!1,q=null,ht=null,ot=null;return{setReversed:function(lt){if(j!==lt){let At=t.get("EXT_clip_control");lt?At.clipControlEXT(At.LOWER_LEFT_EXT,At.ZERO_TO_ONE_EXT):At.clipControlEXT(At.LOWER_LEFT_EXT,At.NEGATIVE_ONE_TO_ONE_EXT),j=lt;let Wt=ot;ot=null,this.setClear(Wt)}},getReversed:function(){return j},setTest:function(lt){lt?gt(i.DEPTH_TEST):Ut(i.DEPTH_TEST)},setMask:function(lt){q!==lt&&!R&&(i.depthMask(lt),q=lt)},setFunc:function(lt){if(j&&(lt=Df[lt]),ht!==lt){switch(lt){case ko:i.depthFunc(i.NEVER);break;case zo:i.depthFunc(i.ALWAYS);break;case Go:i.depthFunc(i.LESS);break;case vs:i.depthFunc(i.LEQUAL);break;case Vo:i.depthFunc(i.EQUAL);break;case Ho:i.depthFunc(i.GEQUAL);break;case Wo:i.depthFunc(i.GREATER);break;case Xo:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}ht=lt}},setLocked:function(lt){R=lt},setClear:function(lt){ot!==lt&&(ot=lt,j&&(lt=1-lt),i.clearDepth(lt))},reset:function(){R=!1,q=null,ht=null,ot=null,j=!1}}}function s(){let R=!1,j=null,q=null,ht=null,ot=null,lt=null,At=null,Wt=null,rt=null;return{setTest:function(Rt){R||(Rt?gt(i.STENCIL_TEST):Ut(i.STENCIL_TEST))},setMask:function(Rt){j!==Rt&&!R&&(i.stencilMask(Rt),j=Rt)},setFunc:function(Rt,Ht,_t){(q!==Rt||ht!==Ht||ot!==_t)&&(i.stencilFunc(Rt,Ht,_t),q=Rt,ht=Ht,ot=_t)},setOp:function(Rt,Ht,_t){(lt!==Rt||At!==Ht||Wt!==_t)&&(i.stencilOp(Rt,Ht,_t),lt=Rt,At=Ht,Wt=_t)},setLocked:function(Rt){R=Rt},setClear:function(Rt){rt!==Rt&&(i.clearStencil(Rt),rt=Rt)},reset:function(){R=!1,j=null,q=null,ht=null,ot=null,lt=null,At=null,Wt=null,rt=null}}}let r=new e,o=new n,a=new s,l={},c=new WeakMap,h={},u={},d={},f=new WeakMap,m=[],x=null,p=!1,g=null,S=null,w=null,b=null,C=null,A=null,_=null,T=new Bt(0,0,0),F=0,L=!1,N=null,z=null,Y=null,I=null,X=null,$=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS),V=!1,it=0,W=i.getParameter(i.VERSION);W.indexOf("WebGL")!==-1?(it=parseFloat(/^WebGL (\d)/.exec(W)[1]),V=it>=1):W.indexOf("OpenGL ES")!==-1&&(it=parseFloat(/^OpenGL ES (\d)/.exec(W)[1]),V=it>=2);let tt=null,et={},Mt=i.getParameter(i.SCISSOR_BOX),It=i.getParameter(i.VIEWPORT),J=new _e().fromArray(Mt),pt=new _e().fromArray(It);function yt(R,j,q,ht){let ot=new Uint8Array(4),lt=i.createTexture();i.bindTexture(R,lt),i.texParameteri(R,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(R,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let At=0;At<q;At++)R===i.TEXTURE_3D||R===i.TEXTURE_2D_ARRAY?i.texImage3D(j,0,i.RGBA,1,1,ht,0,i.RGBA,i.UNSIGNED_BYTE,ot):i.texImage2D(j+At,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,ot);return lt}let Ct={};Ct[i.TEXTURE_2D]=yt(i.TEXTURE_2D,i.TEXTURE_2D,1),Ct[i.TEXTURE_CUBE_MAP]=yt(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),Ct[i.TEXTURE_2D_ARRAY]=yt(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),Ct[i.TEXTURE_3D]=yt(i.TEXTURE_3D,i.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),gt(i.DEPTH_TEST),o.setFunc(vs),je(!1),pe(eh),gt(i.CULL_FACE),Ue(Yi);function gt(R){h[R]!==!0&&(i.enable(R),h[R]=!0)}function Ut(R){h[R]!==!1&&(i.disable(R),h[R]=!1)}function xe(R,j){return d[R]!==j?(i.bindFramebuffer(R,j),d[R]=j,R===i.DRAW_FRAMEBUFFER&&(d[i.FRAMEBUFFER]=j),R===i.FRAMEBUFFER&&(d[i.DRAW_FRAMEBUFFER]=j),!0):!1}function Pt(R,j){let q=m,ht=!1;if(R){q=f.get(j),q===void 0&&(q=[],f.set(j,q));let ot=R.textures;if(q.length!==ot.length||q[0]!==i.COLOR_ATTACHMENT0){for(let lt=0,At=ot.length;lt<At;lt++)q[lt]=i.COLOR_ATTACHMENT0+lt;q.length=ot.length,ht=!0}}else q[0]!==i.BACK&&(q[0]=i.BACK,ht=!0);ht&&i.drawBuffers(q)}function te(R){return x!==R?(i.useProgram(R),x=R,!0):!1}let re={[Zi]:i.FUNC_ADD,[tf]:i.FUNC_SUBTRACT,[ef]:i.FUNC_REVERSE_SUBTRACT};re[nf]=i.MIN,re[sf]=i.MAX;let Yt={[rf]:i.ZERO,[of]:i.ONE,[af]:i.SRC_COLOR,[rh]:i.SRC_ALPHA,[ff]:i.SRC_ALPHA_SATURATE,[uf]:i.DST_COLOR,[cf]:i.DST_ALPHA,[lf]:i.ONE_MINUS_SRC_COLOR,[oh]:i.ONE_MINUS_SRC_ALPHA,[df]:i.ONE_MINUS_DST_COLOR,[hf]:i.ONE_MINUS_DST_ALPHA,[pf]:i.CONSTANT_COLOR,[mf]:i.ONE_MINUS_CONSTANT_COLOR,[gf]:i.CONSTANT_ALPHA,[_f]:i.ONE_MINUS_CONSTANT_ALPHA};function Ue(R,j,q,ht,ot,lt,At,Wt,rt,Rt){if(R===Yi){p===!0&&(Ut(i.BLEND),p=!1);return}if(p===!1&&(gt(i.BLEND),p=!0),R!==Qd){if(R!==g||Rt!==L){if((S!==Zi||C!==Zi)&&(i.blendEquation(i.FUNC_ADD),S=Zi,C=Zi),Rt)switch(R){case Ps:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case nh:i.blendFunc(i.ONE,i.ONE);break;case ih:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case sh:i.blendFuncSeparate(i.DST_COLOR,i.ONE_MINUS_SRC_ALPHA,i.ZERO,i.ONE);break;default:Ot("WebGLState: Invalid blending: ",R);break}else switch(R){case Ps:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case nh:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE,i.ONE,i.ONE);break;case ih:Ot("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case sh:Ot("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:Ot("WebGLState: Invalid blending: ",R);break}w=null,b=null,A=null,_=null,T.set(0,0,0),F=0,g=R,L=Rt}return}ot=ot||j,lt=lt||q,At=At||ht,(j!==S||ot!==C)&&(i.blendEquationSeparate(re[j],re[ot]),S=j,C=ot),(q!==w||ht!==b||lt!==A||At!==_)&&(i.blendFuncSeparate(Yt[q],Yt[ht],Yt[lt],Yt[At]),w=q,b=ht,A=lt,_=At),(Wt.equals(T)===!1||rt!==F)&&(i.blendColor(Wt.r,Wt.g,Wt.b,rt),T.copy(Wt),F=rt),g=R,L=!1}function Ee(R,j){R.side===Xn?Ut(i.CULL_FACE):gt(i.CULL_FACE);let q=R.side===Be;j&&(q=!q),je(q),R.blending===Ps&&R.transparent===!1?Ue(Yi):Ue(R.blending,R.blendEquation,R.blendSrc,R.blendDst,R.blendEquationAlpha,R.blendSrcAlpha,R.blendDstAlpha,R.blendColor,R.blendAlpha,R.premultipliedAlpha),o.setFunc(R.depthFunc),o.setTest(R.depthTest),o.setMask(R.depthWrite),r.setMask(R.colorWrite);let ht=R.stencilWrite;a.setTest(ht),ht&&(a.setMask(R.stencilWriteMask),a.setFunc(R.stencilFunc,R.stencilRef,R.stencilFuncMask),a.setOp(R.stencilFail,R.stencilZFail,R.stencilZPass)),Ie(R.polygonOffset,R.polygonOffsetFactor,R.polygonOffsetUnits),R.alphaToCoverage===!0?gt(i.SAMPLE_ALPHA_TO_COVERAGE):Ut(i.SAMPLE_ALPHA_TO_COVERAGE)}function je(R){N!==R&&(R?i.frontFace(i.CW):i.frontFace(i.CCW),N=R)}function pe(R){R!==Jd?(gt(i.CULL_FACE),R!==z&&(R===eh?i.cullFace(i.BACK):R===Kd?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):Ut(i.CULL_FACE),z=R}function Bn(R){R!==Y&&(V&&i.lineWidth(R),Y=R)}function Ie(R,j,q){R?(gt(i.POLYGON_OFFSET_FILL),(I!==j||X!==q)&&(I=j,X=q,o.getReversed()&&(j=-j,q=-q),i.polygonOffset(j,q))):Ut(i.POLYGON_OFFSET_FILL)}function gn(R){R?gt(i.SCISSOR_TEST):Ut(i.SCISSOR_TEST)}function _n(R){R===void 0&&(R=i.TEXTURE0+$-1),tt!==R&&(i.activeTexture(R),tt=R)}function xn(R,j,q){q===void 0&&(tt===null?q=i.TEXTURE0+$-1:q=tt);let ht=et[q];ht===void 0&&(ht={type:void 0,texture:void 0},et[q]=ht),(ht.type!==R||ht.texture!==j)&&(tt!==q&&(i.activeTexture(q),tt=q),i.bindTexture(R,j||Ct[R]),ht.type=R,ht.texture=j)}function D(){let R=et[tt];R!==void 0&&R.type!==void 0&&(i.bindTexture(R.type,null),R.type=void 0,R.texture=void 0)}function vn(){try{i.compressedTexImage2D(...arguments)}catch(R){Ot("WebGLState:",R)}}function de(){try{i.compressedTexImage3D(...arguments)}catch(R){Ot("WebGLState:",R)}}function fe(){try{i.texSubImage2D(...arguments)}catch(R){Ot("WebGLState:",R)}}function mt(){try{i.texSubImage3D(...arguments)}catch(R){Ot("WebGLState:",R)}}function Ae(){try{i.compressedTexSubImage2D(...arguments)}catch(R){Ot("WebGLState:",R)}}function Lt(){try{i.compressedTexSubImage3D(...arguments)}catch(R){Ot("WebGLState:",R)}}function kt(){try{i.texStorage2D(...arguments)}catch(R){Ot("WebGLState:",R)}}function E(){try{i.texStorage3D(...arguments)}catch(R){Ot("WebGLState:",R)}}function v(){try{i.texImage2D(...arguments)}catch(R){Ot("WebGLState:",R)}}function B(){try{i.texImage3D(...arguments)}catch(R){Ot("WebGLState:",R)}}function st(R){return u[R]!==void 0?u[R]:i.getParameter(R)}function Q(R,j){u[R]!==j&&(i.pixelStorei(R,j),u[R]=j)}function at(R){J.equals(R)===!1&&(i.scissor(R.x,R.y,R.z,R.w),J.copy(R))}function dt(R){pt.equals(R)===!1&&(i.viewport(R.x,R.y,R.z,R.w),pt.copy(R))}function Z(R,j){let q=c.get(j);q===void 0&&(q=new WeakMap,c.set(j,q));let ht=q.get(R);ht===void 0&&(ht=i.getUniformBlockIndex(j,R.name),i.uniformBlockBinding(j,ht,ht),q.set(R,ht))}function K(R,j,q){let ot=c.get(j).get(R);l[ot]!==q&&(i.bindBufferBase(i.UNIFORM_BUFFER,ot,q),l[ot]=q)}function ct(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),o.setReversed(!1),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),i.pixelStorei(i.PACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,!1),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,i.BROWSER_DEFAULT_WEBGL),i.pixelStorei(i.PACK_ROW_LENGTH,0),i.pixelStorei(i.PACK_SKIP_PIXELS,0),i.pixelStorei(i.PACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_ROW_LENGTH,0),i.pixelStorei(i.UNPACK_IMAGE_HEIGHT,0),i.pixelStorei(i.UNPACK_SKIP_PIXELS,0),i.pixelStorei(i.UNPACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_SKIP_IMAGES,0),h={},u={},tt=null,et={},d={},l={},f=new WeakMap,m=[],x=null,p=!1,g=null,S=null,w=null,b=null,C=null,A=null,_=null,T=new Bt(0,0,0),F=0,L=!1,N=null,z=null,Y=null,I=null,X=null,J.set(0,0,i.canvas.width,i.canvas.height),pt.set(0,0,i.canvas.width,i.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:gt,disable:Ut,bindFramebuffer:xe,drawBuffers:Pt,useProgram:te,setBlending:Ue,setMaterial:Ee,setFlipSided:je,setCullFace:pe,setLineWidth:Bn,setPolygonOffset:Ie,setScissorTest:gn,activeTexture:_n,bindTexture:xn,unbindTexture:D,compressedTexImage2D:vn,compressedTexImage3D:de,texImage2D:v,texImage3D:B,pixelStorei:Q,getParameter:st,updateUBOMapping:Z,uniformBlockBinding:K,texStorage2D:kt,texStorage3D:E,texSubImage2D:fe,texSubImage3D:mt,compressedTexSubImage2D:Ae,compressedTexSubImage3D:Lt,scissor:at,viewport:dt,reset:ct}}function PM(i,t,e,n,s,r,o){let a=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new Dt,h=new WeakMap,u=new Set,d,f=new WeakMap,m=new Set,x=new FinalizationRegistry(E=>m.delete(E)),p=!1;try{p=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function g(E,v){return p?new OffscreenCanvas(E,v):dr("canvas")}function S(E,v,B){let st=1,Q=kt(E);if((Q.width>B||Q.height>B)&&(st=B/Math.max(Q.width,Q.height)),st<1)if(typeof HTMLImageElement<"u"&&E instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&E instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&E instanceof ImageBitmap||typeof VideoFrame<"u"&&E instanceof VideoFrame){let at=Math.floor(st*Q.width),dt=Math.floor(st*Q.height);d===void 0&&(d=g(at,dt));let Z=v?g(at,dt):d;return Z.width=at,Z.height=dt,Z.getContext("2d").drawImage(E,0,0,at,dt),Nt("WebGLRenderer: Texture has been resized from ("+Q.width+"x"+Q.height+") to ("+at+"x"+dt+")."),Z}else return"data"in E&&Nt("WebGLRenderer: Image in DataTexture is too big ("+Q.width+"x"+Q.height+")."),E;return E}function w(E){return E.generateMipmaps}function b(E){i.generateMipmap(E)}function C(E){return E.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:E.isWebGL3DRenderTarget?i.TEXTURE_3D:E.isWebGLArrayRenderTarget||E.isCompressedArrayTexture?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D}function A(E,v,B,st,Q,at=!1){if(E!==null){if(i[E]!==void 0)return i[E];Nt("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+E+"'")}let dt;st&&(dt=t.get("EXT_texture_norm16"),dt||Nt("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let Z=v;if(v===i.RED&&(B===i.FLOAT&&(Z=i.R32F),B===i.HALF_FLOAT&&(Z=i.R16F),B===i.UNSIGNED_BYTE&&(Z=i.R8),B===i.UNSIGNED_SHORT&&dt&&(Z=dt.R16_EXT),B===i.SHORT&&dt&&(Z=dt.R16_SNORM_EXT)),v===i.RED_INTEGER&&(B===i.UNSIGNED_BYTE&&(Z=i.R8UI),B===i.UNSIGNED_SHORT&&(Z=i.R16UI),B===i.UNSIGNED_INT&&(Z=i.R32UI),B===i.BYTE&&(Z=i.R8I),B===i.SHORT&&(Z=i.R16I),B===i.INT&&(Z=i.R32I)),v===i.RG&&(B===i.FLOAT&&(Z=i.RG32F),B===i.HALF_FLOAT&&(Z=i.RG16F),B===i.UNSIGNED_BYTE&&(Z=i.RG8),B===i.UNSIGNED_SHORT&&dt&&(Z=dt.RG16_EXT),B===i.SHORT&&dt&&(Z=dt.RG16_SNORM_EXT)),v===i.RG_INTEGER&&(B===i.UNSIGNED_BYTE&&(Z=i.RG8UI),B===i.UNSIGNED_SHORT&&(Z=i.RG16UI),B===i.UNSIGNED_INT&&(Z=i.RG32UI),B===i.BYTE&&(Z=i.RG8I),B===i.SHORT&&(Z=i.RG16I),B===i.INT&&(Z=i.RG32I)),v===i.RGB_INTEGER&&(B===i.UNSIGNED_BYTE&&(Z=i.RGB8UI),B===i.UNSIGNED_SHORT&&(Z=i.RGB16UI),B===i.UNSIGNED_INT&&(Z=i.RGB32UI),B===i.BYTE&&(Z=i.RGB8I),B===i.SHORT&&(Z=i.RGB16I),B===i.INT&&(Z=i.RGB32I)),v===i.RGBA_INTEGER&&(B===i.UNSIGNED_BYTE&&(Z=i.RGBA8UI),B===i.UNSIGNED_SHORT&&(Z=i.RGBA16UI),B===i.UNSIGNED_INT&&(Z=i.RGBA32UI),B===i.BYTE&&(Z=i.RGBA8I),B===i.SHORT&&(Z=i.RGBA16I),B===i.INT&&(Z=i.RGBA32I)),v===i.RGB&&(B===i.UNSIGNED_SHORT&&dt&&(Z=dt.RGB16_EXT),B===i.SHORT&&dt&&(Z=dt.RGB16_SNORM_EXT),B===i.UNSIGNED_INT_5_9_9_9_REV&&(Z=i.RGB9_E5),B===i.UNSIGNED_INT_10F_11F_11F_REV&&(Z=i.R11F_G11F_B10F)),v===i.RGBA){let K=at?hr:Kt.getTransfer(Q);B===i.FLOAT&&(Z=i.RGBA32F),B===i.HALF_FLOAT&&(Z=i.RGBA16F),B===i.UNSIGNED_BYTE&&(Z=K===oe?i.SRGB8_ALPHA8:i.RGBA8),B===i.UNSIGNED_SHORT&&dt&&(Z=dt.RGBA16_EXT),B===i.SHORT&&dt&&(Z=dt.RGBA16_SNORM_EXT),B===i.UNSIGNED_SHORT_4_4_4_4&&(Z=i.RGBA4),B===i.UNSIGNED_SHORT_5_5_5_1&&(Z=i.RGB5_A1)}return(Z===i.R16F||Z===i.R32F||Z===i.RG16F||Z===i.RG32F||Z===i.RGBA16F||Z===i.RGBA32F)&&t.get("EXT_color_buffer_float"),Z}function _(E,v){let B;return E?v===null||v===Ln||v===Ki?B=i.DEPTH24_STENCIL8:v===pn?B=i.DEPTH32F_STENCIL8:v===Ls&&(B=i.DEPTH24_STENCIL8,Nt("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):v===null||v===Ln||v===Ki?B=i.DEPTH_COMPONENT24:v===pn?B=i.DEPTH_COMPONENT32F:v===Ls&&(B=i.DEPTH_COMPONENT16),B}function T(E,v){return w(E)===!0||E.isFramebufferTexture&&E.minFilter!==ve&&E.minFilter!==Ze?Math.log2(Math.max(v.width,v.height))+1:E.mipmaps.length>0?E.mipmaps.length:E.isCompressedTexture&&Array.isArray(E.image)?v.mipmaps.length:1}function F(E){let v=new WeakRef(E);n.get(E).__ref=v,m.add(v),x.register(E,v,v)}function L(E){let v=n.get(E).__ref;v!==void 0&&(m.delete(v),x.unregister(v))}function N(E){Y(E.target)}function z(E){I(E.target)}function Y(E){E.removeEventListener("dispose",N),L(E),$(E),E.isVideoTexture&&h.delete(E),E.isHTMLTexture&&u.delete(E)}function I(E){E.removeEventListener("dispose",z),L(E),it(E)}function X(){for(let E of m){let v=E.deref();v!==void 0&&(v.isRenderTarget===!0?I(v):Y(v))}m.clear(),u.clear()}function $(E){let v=n.get(E);if(v.__webglInit===void 0)return;let B=E.source,st=f.get(B);if(st){let Q=st[v.__cacheKey];Q.usedTimes--,Q.usedTimes===0&&V(E),Object.keys(st).length===0&&f.delete(B)}n.remove(E)}function V(E){let v=n.get(E);i.deleteTexture(v.__webglTexture);let B=E.source,st=f.get(B);delete st[v.__cacheKey],o.memory.textures--}function it(E){let v=n.get(E);v.__depthDisposeCallback&&v.__depthDisposeCallback();let B=E.depthTexture;if(B&&B.renderTarget===E&&Y(B),E.isWebGLCubeRenderTarget)for(let Q=0;Q<6;Q++){if(Array.isArray(v.__webglFramebuffer[Q]))for(let at=0;at<v.__webglFramebuffer[Q].length;at++)i.deleteFramebuffer(v.__webglFramebuffer[Q][at]);else i.deleteFramebuffer(v.__webglFramebuffer[Q]);v.__webglDepthbuffer&&i.deleteRenderbuffer(v.__webglDepthbuffer[Q])}else{if(Array.isArray(v.__webglFramebuffer))for(let Q=0;Q<v.__webglFramebuffer.length;Q++)i.deleteFramebuffer(v.__webglFramebuffer[Q]);else i.deleteFramebuffer(v.__webglFramebuffer);if(v.__webglDepthbuffer&&i.deleteRenderbuffer(v.__webglDepthbuffer),v.__webglMultisampledFramebuffer&&i.deleteFramebuffer(v.__webglMultisampledFramebuffer),v.__webglColorRenderbuffer)for(let Q=0;Q<v.__webglColorRenderbuffer.length;Q++)v.__webglColorRenderbuffer[Q]&&i.deleteRenderbuffer(v.__webglColorRenderbuffer[Q]);v.__webglDepthRenderbuffer&&i.deleteRenderbuffer(v.__webglDepthRenderbuffer)}let st=E.textures;for(let Q=0,at=st.length;Q<at;Q++){let dt=n.get(st[Q]);dt.__webglTexture&&(i.deleteTexture(dt.__webglTexture),o.memory.textures--),n.remove(st[Q])}n.remove(E)}let W=0;function tt(){W=0}function et(){return W}function Mt(E){W=E}function It(){let E=W;return E>=s.maxTextures&&Nt("WebGLTextures: Trying to use "+(E+1)+" texture units while this GPU supports only "+s.maxTextures),W+=1,E}function J(E){let v=[];return v.push(E.wrapS),v.push(E.wrapT),v.push(E.wrapR||0),v.push(E.magFilter),v.push(E.minFilter),v.push(E.anisotropy),v.push(E.internalFormat),v.push(E.format),v.push(E.type),v.push(E.generateMipmaps),v.push(E.mipmapsAutoUpdate),v.push(E.premultiplyAlpha),v.push(E.flipY),v.push(E.unpackAlignment),v.push(E.colorSpace),v.join()}function pt(E,v){let B=n.get(E);if(E.isVideoTexture&&Ae(E),E.isRenderTargetTexture===!1&&E.isExternalTexture!==!0&&E.version>0&&B.__version!==E.version){let st=E.image;if(st===null)Nt("WebGLRenderer: Texture marked for update but no image data found.");else if(st.complete===!1)Nt("WebGLRenderer: Texture marked for update but image is incomplete");else{Ee(B,E,v);return}}else E.isExternalTexture&&(B.__webglTexture=E.sourceTexture?E.sourceTexture:null);e.bindTexture(i.TEXTURE_2D,B.__webglTexture,i.TEXTURE0+v)}function yt(E,v){let B=n.get(E);if(E.isRenderTargetTexture===!1&&E.version>0&&B.__version!==E.version){Ee(B,E,v);return}else E.isExternalTexture&&(B.__webglTexture=E.sourceTexture?E.sourceTexture:null);e.bindTexture(i.TEXTURE_2D_ARRAY,B.__webglTexture,i.TEXTURE0+v)}function Ct(E,v){let B=n.get(E);if(E.isRenderTargetTexture===!1&&E.version>0&&B.__version!==E.version){Ee(B,E,v);return}e.bindTexture(i.TEXTURE_3D,B.__webglTexture,i.TEXTURE0+v)}function gt(E,v){let B=n.get(E);if(E.version>0&&B.__version!==E.version){je(B,E,v);return}e.bindTexture(i.TEXTURE_CUBE_MAP,B.__webglTexture,i.TEXTURE0+v)}let Ut={[qo]:i.REPEAT,[zn]:i.CLAMP_TO_EDGE,[$o]:i.MIRRORED_REPEAT},xe={[ve]:i.NEAREST,[yf]:i.NEAREST_MIPMAP_NEAREST,[Ir]:i.NEAREST_MIPMAP_LINEAR,[Ze]:i.LINEAR,[_a]:i.LINEAR_MIPMAP_NEAREST,[ci]:i.LINEAR_MIPMAP_LINEAR},Pt={[wf]:i.NEVER,[Eh]:i.ALWAYS,[Tf]:i.LESS,[wh]:i.LEQUAL,[Ef]:i.EQUAL,[Th]:i.GEQUAL,[Af]:i.GREATER,[Cf]:i.NOTEQUAL};function te(E,v){if(v.type===pn&&t.has("OES_texture_float_linear")===!1&&(v.magFilter===Ze||v.magFilter===_a||v.magFilter===Ir||v.magFilter===ci||v.minFilter===Ze||v.minFilter===_a||v.minFilter===Ir||v.minFilter===ci)&&Nt("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(E,i.TEXTURE_WRAP_S,Ut[v.wrapS]),i.texParameteri(E,i.TEXTURE_WRAP_T,Ut[v.wrapT]),(E===i.TEXTURE_3D||E===i.TEXTURE_2D_ARRAY)&&i.texParameteri(E,i.TEXTURE_WRAP_R,Ut[v.wrapR]),i.texParameteri(E,i.TEXTURE_MAG_FILTER,xe[v.magFilter]),i.texParameteri(E,i.TEXTURE_MIN_FILTER,xe[v.minFilter]),v.compareFunction&&(i.texParameteri(E,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(E,i.TEXTURE_COMPARE_FUNC,Pt[v.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(v.magFilter===ve||v.minFilter!==Ir&&v.minFilter!==ci||v.type===pn&&t.has("OES_texture_float_linear")===!1)return;if(v.anisotropy>1||n.get(v).__currentAnisotropy){let B=t.get("EXT_texture_filter_anisotropic");i.texParameterf(E,B.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(v.anisotropy,s.getMaxAnisotropy())),n.get(v).__currentAnisotropy=v.anisotropy}}}function re(E,v){let B=!1;E.__webglInit===void 0&&(E.__webglInit=!0,v.addEventListener("dispose",N),F(v));let st=v.source,Q=f.get(st);Q===void 0&&(Q={},f.set(st,Q));let at=J(v);if(at!==E.__cacheKey){Q[at]===void 0&&(Q[at]={texture:i.createTexture(),usedTimes:0},o.memory.textures++,B=!0),Q[at].usedTimes++;let dt=Q[E.__cacheKey];dt!==void 0&&(Q[E.__cacheKey].usedTimes--,dt.usedTimes===0&&V(v)),E.__cacheKey=at,E.__webglTexture=Q[at].texture}return B}function Yt(E,v,B){return Math.floor(Math.floor(E/B)/v)}function Ue(E,v,B,st){let at=E.updateRanges;if(at.length===0)e.texSubImage2D(i.TEXTURE_2D,0,0,0,v.width,v.height,B,st,v.data);else{at.sort((R,j)=>R.start-j.start);let dt=0;for(let R=1;R<at.length;R++){let j=at[dt],q=at[R],ht=j.start+j.count,ot=Yt(q.start,v.width,4),lt=Yt(j.start,v.width,4);q.start<=ht+1&&ot===lt&&Yt(q.start+q.count-1,v.width,4)===ot?j.count=Math.max(j.count,q.start+q.count-j.start):(++dt,at[dt]=q)}at.length=dt+1;let Z=e.getParameter(i.UNPACK_ROW_LENGTH),K=e.getParameter(i.UNPACK_SKIP_PIXELS),ct=e.getParameter(i.UNPACK_SKIP_ROWS);e.pixelStorei(i.UNPACK_ROW_LENGTH,v.width);for(let R=0,j=at.length;R<j;R++){let q=at[R],ht=Math.floor(q.start/4),ot=Math.ceil(q.count/4),lt=ht%v.width,At=Math.floor(ht/v.width),Wt=ot,rt=1;e.pixelStorei(i.UNPACK_SKIP_PIXELS,lt),e.pixelStorei(i.UNPACK_SKIP_ROWS,At),e.texSubImage2D(i.TEXTURE_2D,0,lt,At,Wt,rt,B,st,v.data)}E.clearUpdateRanges(),e.pixelStorei(i.UNPACK_ROW_LENGTH,Z),e.pixelStorei(i.UNPACK_SKIP_PIXELS,K),e.pixelStorei(i.UNPACK_SKIP_ROWS,ct)}}function Ee(E,v,B){let st=i.TEXTURE_2D;(v.isDataArrayTexture||v.isCompressedArrayTexture)&&(st=i.TEXTURE_2D_ARRAY),v.isData3DTexture&&(st=i.TEXTURE_3D);let Q=re(E,v),at=v.source;e.bindTexture(st,E.__webglTexture,i.TEXTURE0+B);let dt=n.get(at);if(at.version!==dt.__version||Q===!0){if(e.activeTexture(i.TEXTURE0+B),(typeof ImageBitmap<"u"&&v.image instanceof ImageBitmap)===!1){let rt=Kt.getPrimaries(Kt.workingColorSpace),Rt=v.colorSpace===ui?null:Kt.getPrimaries(v.colorSpace),Ht=v.colorSpace===ui||rt===Rt?i.NONE:i.BROWSER_DEFAULT_WEBGL;e.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,v.flipY),e.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,v.premultiplyAlpha),e.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,Ht)}e.pixelStorei(i.UNPACK_ALIGNMENT,v.unpackAlignment);let K=S(v.image,!1,s.maxTextureSize);K=Lt(v,K);let ct=r.convert(v.format,v.colorSpace),R=r.convert(v.type),j=A(v.internalFormat,ct,R,v.normalized,v.colorSpace,v.isVideoTexture);te(st,v);let q,ht=v.mipmaps,ot=v.isVideoTexture!==!0,lt=dt.__version===void 0||Q===!0,At=at.dataReady,Wt=T(v,K);if(v.isDepthTexture)j=_(v.format===hi,v.type),lt&&(ot?e.texStorage2D(i.TEXTURE_2D,1,j,K.width,K.height):e.texImage2D(i.TEXTURE_2D,0,j,K.width,K.height,0,ct,R,null));else if(v.isDataTexture)if(ht.length>0){ot&&lt&&e.texStorage2D(i.TEXTURE_2D,Wt,j,ht[0].width,ht[0].height);for(let rt=0,Rt=ht.length;rt<Rt;rt++)q=ht[rt],ot?At&&e.texSubImage2D(i.TEXTURE_2D,rt,0,0,q.width,q.height,ct,R,q.data):e.texImage2D(i.TEXTURE_2D,rt,j,q.width,q.height,0,ct,R,q.data);v.generateMipmaps=!1}else ot?(lt&&e.texStorage2D(i.TEXTURE_2D,Wt,j,K.width,K.height),At&&Ue(v,K,ct,R)):e.texImage2D(i.TEXTURE_2D,0,j,K.width,K.height,0,ct,R,K.data);else if(v.isCompressedTexture)if(v.isCompressedArrayTexture){ot&&lt&&e.texStorage3D(i.TEXTURE_2D_ARRAY,Wt,j,ht[0].width,ht[0].height,K.depth);for(let rt=0,Rt=ht.length;rt<Rt;rt++)if(q=ht[rt],v.format!==Ke)if(ct!==null)if(ot){if(At)if(v.layerUpdates.size>0){let Ht=Oh(q.width,q.height,v.format,v.type);for(let _t of v.layerUpdates){let ae=q.data.subarray(_t*Ht/q.data.BYTES_PER_ELEMENT,(_t+1)*Ht/q.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,rt,0,0,_t,q.width,q.height,1,ct,ae)}}else e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,rt,0,0,0,q.width,q.height,K.depth,ct,q.data)}else e.compressedTexImage3D(i.TEXTURE_2D_ARRAY,rt,j,q.width,q.height,K.depth,0,q.data,0,0);else Nt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else ot?At&&e.texSubImage3D(i.TEXTURE_2D_ARRAY,rt,0,0,0,q.width,q.height,K.depth,ct,R,q.data):e.texImage3D(i.TEXTURE_2D_ARRAY,rt,j,q.width,q.height,K.depth,0,ct,R,q.data);v.layerUpdates.size>0&&v.clearLayerUpdates()}else{ot&&lt&&e.texStorage2D(i.TEXTURE_2D,Wt,j,ht[0].width,ht[0].height);for(let rt=0,Rt=ht.length;rt<Rt;rt++)q=ht[rt],v.format!==Ke?ct!==null?ot?At&&e.compressedTexSubImage2D(i.TEXTURE_2D,rt,0,0,q.width,q.height,ct,q.data):e.compressedTexImage2D(i.TEXTURE_2D,rt,j,q.width,q.height,0,q.data):Nt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):ot?At&&e.texSubImage2D(i.TEXTURE_2D,rt,0,0,q.width,q.height,ct,R,q.data):e.texImage2D(i.TEXTURE_2D,rt,j,q.width,q.height,0,ct,R,q.data)}else if(v.isDataArrayTexture)if(ot){if(lt&&e.texStorage3D(i.TEXTURE_2D_ARRAY,Wt,j,K.width,K.height,K.depth),At)if(v.layerUpdates.size>0){let rt=Oh(K.width,K.height,v.format,v.type);for(let Rt of v.layerUpdates){let Ht=K.data.subarray(Rt*rt/K.data.BYTES_PER_ELEMENT,(Rt+1)*rt/K.data.BYTES_PER_ELEMENT);e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,Rt,K.width,K.height,1,ct,R,Ht)}v.clearLayerUpdates()}else e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,K.width,K.height,K.depth,ct,R,K.data)}else e.texImage3D(i.TEXTURE_2D_ARRAY,0,j,K.width,K.height,K.depth,0,ct,R,K.data);else if(v.isData3DTexture)ot?(lt&&e.texStorage3D(i.TEXTURE_3D,Wt,j,K.width,K.height,K.depth),At&&e.texSubImage3D(i.TEXTURE_3D,0,0,0,0,K.width,K.height,K.depth,ct,R,K.data)):e.texImage3D(i.TEXTURE_3D,0,j,K.width,K.height,K.depth,0,ct,R,K.data);else if(v.isFramebufferTexture){if(lt)if(ot)e.texStorage2D(i.TEXTURE_2D,Wt,j,K.width,K.height);else{let rt=K.width,Rt=K.height;for(let Ht=0;Ht<Wt;Ht++)e.texImage2D(i.TEXTURE_2D,Ht,j,rt,Rt,0,ct,R,null),rt>>=1,Rt>>=1}}else if(v.isHTMLTexture){if("texElementImage2D"in i){let rt=i.canvas;if(rt.hasAttribute("layoutsubtree")||rt.setAttribute("layoutsubtree","true"),K.parentNode!==rt){rt.appendChild(K),u.add(v),rt.onpaint=Rt=>{let Ht=Rt.changedElements;for(let _t of u)Ht.includes(_t.image)&&(_t.needsUpdate=!0)},rt.requestPaint();return}if(i.texElementImage2D.length===3)i.texElementImage2D(i.TEXTURE_2D,i.RGBA8,K);else{let Ht=i.RGBA,_t=i.RGBA,ae=i.UNSIGNED_BYTE;i.texElementImage2D(i.TEXTURE_2D,0,Ht,_t,ae,K)}i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MIN_FILTER,i.LINEAR),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_S,i.CLAMP_TO_EDGE),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_T,i.CLAMP_TO_EDGE)}}else if(ht.length>0){if(ot&&lt){let rt=kt(ht[0]);e.texStorage2D(i.TEXTURE_2D,Wt,j,rt.width,rt.height)}for(let rt=0,Rt=ht.length;rt<Rt;rt++)q=ht[rt],ot?At&&e.texSubImage2D(i.TEXTURE_2D,rt,0,0,ct,R,q):e.texImage2D(i.TEXTURE_2D,rt,j,ct,R,q);v.generateMipmaps=!1}else if(ot){if(lt){let rt=kt(K);e.texStorage2D(i.TEXTURE_2D,Wt,j,rt.width,rt.height)}At&&e.texSubImage2D(i.TEXTURE_2D,0,0,0,ct,R,K)}else e.texImage2D(i.TEXTURE_2D,0,j,ct,R,K);w(v)&&v.mipmapsAutoUpdate===!0&&b(st),dt.__version=at.version,v.onUpdate&&v.onUpdate(v)}E.__version=v.version}function je(E,v,B){if(v.image.length!==6)return;let st=re(E,v),Q=v.source;e.bindTexture(i.TEXTURE_CUBE_MAP,E.__webglTexture,i.TEXTURE0+B);let at=n.get(Q);if(Q.version!==at.__version||st===!0){e.activeTexture(i.TEXTURE0+B);let dt=Kt.getPrimaries(Kt.workingColorSpace),Z=v.colorSpace===ui?null:Kt.getPrimaries(v.colorSpace),K=v.colorSpace===ui||dt===Z?i.NONE:i.BROWSER_DEFAULT_WEBGL;e.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,v.flipY),e.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,v.premultiplyAlpha),e.pixelStorei(i.UNPACK_ALIGNMENT,v.unpackAlignment),e.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,K);let ct=v.isCompressedTexture||v.image[0].isCompressedTexture,R=v.image[0]&&v.image[0].isDataTexture,j=[];for(let _t=0;_t<6;_t++)!ct&&!R?j[_t]=S(v.image[_t],!0,s.maxCubemapSize):j[_t]=R?v.image[_t].image:v.image[_t],j[_t]=Lt(v,j[_t]);let q=j[0],ht=r.convert(v.format,v.colorSpace),ot=r.convert(v.type),lt=A(v.internalFormat,ht,ot,v.normalized,v.colorSpace),At=v.isVideoTexture!==!0,Wt=at.__version===void 0||st===!0,rt=Q.dataReady,Rt=T(v,q);te(i.TEXTURE_CUBE_MAP,v);let Ht;if(v.isDepthTexture){if(lt=_(v.format===hi,v.type),Wt)if(At)e.texStorage2D(i.TEXTURE_CUBE_MAP,1,lt,q.width,q.height);else for(let _t=0;_t<6;_t++)e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+_t,0,lt,q.width,q.height,0,ht,ot,null)}else if(ct){At&&Wt&&e.texStorage2D(i.TEXTURE_CUBE_MAP,Rt,lt,q.width,q.height);for(let _t=0;_t<6;_t++){Ht=j[_t].mipmaps;for(let ae=0;ae<Ht.length;ae++){let Le=Ht[ae];v.format!==Ke?ht!==null?At?rt&&e.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+_t,ae,0,0,Le.width,Le.height,ht,Le.data):e.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+_t,ae,lt,Le.width,Le.height,0,Le.data):Nt("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):At?rt&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+_t,ae,0,0,Le.width,Le.height,ht,ot,Le.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+_t,ae,lt,Le.width,Le.height,0,ht,ot,Le.data)}}}else{if(Ht=v.mipmaps,At&&Wt){Ht.length>0&&Rt++;let _t=kt(j[0]);e.texStorage2D(i.TEXTURE_CUBE_MAP,Rt,lt,_t.width,_t.height)}for(let _t=0;_t<6;_t++)if(R){At?rt&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+_t,0,0,0,j[_t].width,j[_t].height,ht,ot,j[_t].data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+_t,0,lt,j[_t].width,j[_t].height,0,ht,ot,j[_t].data);for(let ae=0;ae<Ht.length;ae++){let pi=Ht[ae].image[_t].image;At?rt&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+_t,ae+1,0,0,pi.width,pi.height,ht,ot,pi.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+_t,ae+1,lt,pi.width,pi.height,0,ht,ot,pi.data)}}else{At?rt&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+_t,0,0,0,ht,ot,j[_t]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+_t,0,lt,ht,ot,j[_t]);for(let ae=0;ae<Ht.length;ae++){let Le=Ht[ae];At?rt&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+_t,ae+1,0,0,ht,ot,Le.image[_t]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+_t,ae+1,lt,ht,ot,Le.image[_t])}}}w(v)&&v.mipmapsAutoUpdate===!0&&b(i.TEXTURE_CUBE_MAP),at.__version=Q.version,v.onUpdate&&v.onUpdate(v)}E.__version=v.version}function pe(E,v,B,st,Q,at){let dt=r.convert(B.format,B.colorSpace),Z=r.convert(B.type),K=A(B.internalFormat,dt,Z,B.normalized,B.colorSpace),ct=n.get(v),R=n.get(B);if(R.__renderTarget=v,!ct.__hasExternalTextures){let j=Math.max(1,v.width>>at),q=Math.max(1,v.height>>at);Q===i.TEXTURE_3D||Q===i.TEXTURE_2D_ARRAY?e.texImage3D(Q,at,K,j,q,v.depth,0,dt,Z,null):e.texImage2D(Q,at,K,j,q,0,dt,Z,null)}e.bindFramebuffer(i.FRAMEBUFFER,E),mt(v)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,st,Q,R.__webglTexture,0,fe(v)):(Q===i.TEXTURE_2D||Q>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&Q<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,st,Q,R.__webglTexture,at),e.bindFramebuffer(i.FRAMEBUFFER,null)}function Bn(E,v,B){if(i.bindRenderbuffer(i.RENDERBUFFER,E),v.depthBuffer){let st=v.depthTexture,Q=st&&st.isDepthTexture?st.type:null,at=_(v.stencilBuffer,Q),dt=v.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;mt(v)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,fe(v),at,v.width,v.height):B?i.renderbufferStorageMultisample(i.RENDERBUFFER,fe(v),at,v.width,v.height):i.renderbufferStorage(i.RENDERBUFFER,at,v.width,v.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,dt,i.RENDERBUFFER,E)}else{let st=v.textures;for(let Q=0;Q<st.length;Q++){let at=st[Q],dt=r.convert(at.format,at.colorSpace),Z=r.convert(at.type),K=A(at.internalFormat,dt,Z,at.normalized,at.colorSpace);mt(v)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,fe(v),K,v.width,v.height):B?i.renderbufferStorageMultisample(i.RENDERBUFFER,fe(v),K,v.width,v.height):i.renderbufferStorage(i.RENDERBUFFER,K,v.width,v.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function Ie(E,v,B){let st=v.isWebGLCubeRenderTarget===!0;if(e.bindFramebuffer(i.FRAMEBUFFER,E),!(v.depthTexture&&v.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let Q=n.get(v.depthTexture);Q.__renderTarget=v;let at=st?v.depthTexture.image[0]:v.depthTexture.image;(!Q.__webglTexture||at.width!==v.width||at.height!==v.height)&&(at.width=v.width,at.height=v.height,v.depthTexture.needsUpdate=!0),st?gt(v.depthTexture,0):pt(v.depthTexture,0);let dt=Q.__webglTexture,Z=fe(v),K=st?i.TEXTURE_CUBE_MAP_POSITIVE_X+B:i.TEXTURE_2D,ct=v.depthTexture.format===hi?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;if(v.depthTexture.format===ai)mt(v)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ct,K,dt,0,Z):i.framebufferTexture2D(i.FRAMEBUFFER,ct,K,dt,0);else if(v.depthTexture.format===hi)mt(v)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ct,K,dt,0,Z):i.framebufferTexture2D(i.FRAMEBUFFER,ct,K,dt,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function gn(E){let v=n.get(E),B=E.isWebGLCubeRenderTarget===!0;if(v.__boundDepthTexture!==E.depthTexture){let st=E.depthTexture;if(v.__depthDisposeCallback&&v.__depthDisposeCallback(),st){let Q=()=>{delete v.__boundDepthTexture,delete v.__depthDisposeCallback,st.removeEventListener("dispose",Q)};st.addEventListener("dispose",Q),v.__depthDisposeCallback=Q}v.__boundDepthTexture=st}if(E.depthTexture&&!v.__autoAllocateDepthBuffer)if(B)for(let st=0;st<6;st++)Ie(v.__webglFramebuffer[st],E,st);else E.texture.mipmaps.length>0?Ie(v.__webglFramebuffer[0],E,0):Ie(v.__webglFramebuffer,E,0);else if(B){v.__webglDepthbuffer=[];for(let st=0;st<6;st++)if(e.bindFramebuffer(i.FRAMEBUFFER,v.__webglFramebuffer[st]),v.__webglDepthbuffer[st]===void 0)v.__webglDepthbuffer[st]=i.createRenderbuffer(),Bn(v.__webglDepthbuffer[st],E,!1);else{let Q=E.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,at=v.__webglDepthbuffer[st];i.bindRenderbuffer(i.RENDERBUFFER,at),i.framebufferRenderbuffer(i.FRAMEBUFFER,Q,i.RENDERBUFFER,at)}}else if(E.texture.mipmaps.length>0?e.bindFramebuffer(i.FRAMEBUFFER,v.__webglFramebuffer[0]):e.bindFramebuffer(i.FRAMEBUFFER,v.__webglFramebuffer),v.__webglDepthbuffer===void 0)v.__webglDepthbuffer=i.createRenderbuffer(),Bn(v.__webglDepthbuffer,E,!1);else{let Q=E.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,at=v.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,at),i.framebufferRenderbuffer(i.FRAMEBUFFER,Q,i.RENDERBUFFER,at)}e.bindFramebuffer(i.FRAMEBUFFER,null)}function _n(E,v,B){let st=n.get(E);v!==void 0&&pe(st.__webglFramebuffer,E,E.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),B!==void 0&&gn(E)}function xn(E){let v=E.texture,B=n.get(E),st=n.get(v);E.addEventListener("dispose",z),F(E);let Q=E.textures,at=E.isWebGLCubeRenderTarget===!0,dt=Q.length>1;if(dt||(st.__webglTexture===void 0&&(st.__webglTexture=i.createTexture()),st.__version=v.version,o.memory.textures++),at){B.__webglFramebuffer=[];for(let Z=0;Z<6;Z++)if(v.mipmaps.length>0){B.__webglFramebuffer[Z]=[];for(let K=0;K<v.mipmaps.length;K++)B.__webglFramebuffer[Z][K]=i.createFramebuffer()}else B.__webglFramebuffer[Z]=i.createFramebuffer()}else{if(v.mipmaps.length>0){B.__webglFramebuffer=[];for(let Z=0;Z<v.mipmaps.length;Z++)B.__webglFramebuffer[Z]=i.createFramebuffer()}else B.__webglFramebuffer=i.createFramebuffer();if(dt)for(let Z=0,K=Q.length;Z<K;Z++){let ct=n.get(Q[Z]);ct.__webglTexture===void 0&&(ct.__webglTexture=i.createTexture(),o.memory.textures++)}if(E.samples>0&&mt(E)===!1){B.__webglMultisampledFramebuffer=i.createFramebuffer(),B.__webglColorRenderbuffer=[],e.bindFramebuffer(i.FRAMEBUFFER,B.__webglMultisampledFramebuffer);for(let Z=0;Z<Q.length;Z++){let K=Q[Z];B.__webglColorRenderbuffer[Z]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,B.__webglColorRenderbuffer[Z]);let ct=r.convert(K.format,K.colorSpace),R=r.convert(K.type),j=A(K.internalFormat,ct,R,K.normalized,K.colorSpace,E.isXRRenderTarget===!0),q=fe(E);i.renderbufferStorageMultisample(i.RENDERBUFFER,q,j,E.width,E.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+Z,i.RENDERBUFFER,B.__webglColorRenderbuffer[Z])}i.bindRenderbuffer(i.RENDERBUFFER,null),E.depthBuffer&&(B.__webglDepthRenderbuffer=i.createRenderbuffer(),Bn(B.__webglDepthRenderbuffer,E,!0)),e.bindFramebuffer(i.FRAMEBUFFER,null)}}if(at){e.bindTexture(i.TEXTURE_CUBE_MAP,st.__webglTexture),te(i.TEXTURE_CUBE_MAP,v);for(let Z=0;Z<6;Z++)if(v.mipmaps.length>0)for(let K=0;K<v.mipmaps.length;K++)pe(B.__webglFramebuffer[Z][K],E,v,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+Z,K);else pe(B.__webglFramebuffer[Z],E,v,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+Z,0);w(v)?b(i.TEXTURE_CUBE_MAP):v.mipmaps.length>0&&i.texParameteri(i.TEXTURE_CUBE_MAP,i.TEXTURE_MAX_LEVEL,v.mipmaps.length-1),e.unbindTexture()}else if(dt){for(let Z=0,K=Q.length;Z<K;Z++){let ct=Q[Z],R=n.get(ct),j=i.TEXTURE_2D;(E.isWebGL3DRenderTarget||E.isWebGLArrayRenderTarget)&&(j=E.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),e.bindTexture(j,R.__webglTexture),te(j,ct),pe(B.__webglFramebuffer,E,ct,i.COLOR_ATTACHMENT0+Z,j,0),w(ct)&&b(j)}e.unbindTexture()}else{let Z=i.TEXTURE_2D;if((E.isWebGL3DRenderTarget||E.isWebGLArrayRenderTarget)&&(Z=E.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),e.bindTexture(Z,st.__webglTexture),te(Z,v),v.mipmaps.length>0)for(let K=0;K<v.mipmaps.length;K++)pe(B.__webglFramebuffer[K],E,v,i.COLOR_ATTACHMENT0,Z,K);else pe(B.__webglFramebuffer,E,v,i.COLOR_ATTACHMENT0,Z,0);w(v)?b(Z):v.mipmaps.length>0&&i.texParameteri(Z,i.TEXTURE_MAX_LEVEL,v.mipmaps.length-1),e.unbindTexture()}E.depthBuffer&&gn(E)}function D(E){let v=E.textures;for(let B=0,st=v.length;B<st;B++){let Q=v[B];if(w(Q)&&Q.mipmapsAutoUpdate===!0){let at=C(E),dt=n.get(Q).__webglTexture;e.bindTexture(at,dt),b(at),e.unbindTexture()}}}let vn=[];function de(E){if(E.samples>0){if(mt(E)===!1){let v=E.textures,B=E.width,st=E.height,Q=i.COLOR_BUFFER_BIT,at=E.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,dt=n.get(E),Z=v.length>1;if(Z)for(let ct=0;ct<v.length;ct++)e.bindFramebuffer(i.FRAMEBUFFER,dt.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ct,i.RENDERBUFFER,null),e.bindFramebuffer(i.FRAMEBUFFER,dt.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ct,i.TEXTURE_2D,null,0);e.bindFramebuffer(i.READ_FRAMEBUFFER,dt.__webglMultisampledFramebuffer),E.texture.mipmaps.length>0?e.bindFramebuffer(i.DRAW_FRAMEBUFFER,dt.__webglFramebuffer[0]):e.bindFramebuffer(i.DRAW_FRAMEBUFFER,dt.__webglFramebuffer);for(let ct=0;ct<v.length;ct++){if(E.resolveDepthBuffer&&(E.depthBuffer&&(Q|=i.DEPTH_BUFFER_BIT),E.stencilBuffer&&E.resolveStencilBuffer&&(Q|=i.STENCIL_BUFFER_BIT)),Z){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,dt.__webglColorRenderbuffer[ct]);let R=n.get(v[ct]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,R,0)}i.blitFramebuffer(0,0,B,st,0,0,B,st,Q,i.NEAREST),l===!0&&(vn.length=0,vn.push(i.COLOR_ATTACHMENT0+ct),E.depthBuffer&&E.storeMultisampledDepthBuffer===!1&&vn.push(at),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,vn))}if(e.bindFramebuffer(i.READ_FRAMEBUFFER,null),e.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),Z)for(let ct=0;ct<v.length;ct++){e.bindFramebuffer(i.FRAMEBUFFER,dt.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ct,i.RENDERBUFFER,dt.__webglColorRenderbuffer[ct]);let R=n.get(v[ct]).__webglTexture;e.bindFramebuffer(i.FRAMEBUFFER,dt.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ct,i.TEXTURE_2D,R,0)}e.bindFramebuffer(i.DRAW_FRAMEBUFFER,dt.__webglMultisampledFramebuffer)}else if(E.depthBuffer&&E.storeMultisampledDepthBuffer===!1&&l){let v=E.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[v])}}}function fe(E){return Math.min(s.maxSamples,E.samples)}function mt(E){let v=n.get(E);return E.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&v.__useRenderToTexture!==!1}function Ae(E){let v=o.render.frame;h.get(E)!==v&&(h.set(E,v),E.update())}function Lt(E,v){let B=E.colorSpace,st=E.format,Q=E.type;return E.isCompressedTexture===!0||E.isVideoTexture===!0||B!==cr&&B!==ui&&(Kt.getTransfer(B)===oe?(st!==Ke||Q!==Je)&&Nt("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):Ot("WebGLTextures: Unsupported texture color space:",B)),v}function kt(E){return typeof HTMLImageElement<"u"&&E instanceof HTMLImageElement?(c.width=E.naturalWidth||E.width,c.height=E.naturalHeight||E.height):typeof VideoFrame<"u"&&E instanceof VideoFrame?(c.width=E.displayWidth,c.height=E.displayHeight):(c.width=E.width,c.height=E.height),c}this.allocateTextureUnit=It,this.resetTextureUnits=tt,this.getTextureUnits=et,this.setTextureUnits=Mt,this.setTexture2D=pt,this.setTexture2DArray=yt,this.setTexture3D=Ct,this.setTextureCube=gt,this.rebindTextures=_n,this.setupRenderTarget=xn,this.updateRenderTargetMipmap=D,this.updateMultisampleRenderTarget=de,this.setupDepthRenderbuffer=gn,this.setupFrameBufferTexture=pe,this.useMultisampledRTT=mt,this.dispose=X}function IM(i,t){function e(n,s=ui){let r,o=Kt.getTransfer(s);if(n===Je)return i.UNSIGNED_BYTE;if(n===va)return i.UNSIGNED_SHORT_4_4_4_4;if(n===ya)return i.UNSIGNED_SHORT_5_5_5_1;if(n===xh)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===vh)return i.UNSIGNED_INT_10F_11F_11F_REV;if(n===gh)return i.BYTE;if(n===_h)return i.SHORT;if(n===Ls)return i.UNSIGNED_SHORT;if(n===xa)return i.INT;if(n===Ln)return i.UNSIGNED_INT;if(n===pn)return i.FLOAT;if(n===Dn)return i.HALF_FLOAT;if(n===yh)return i.ALPHA;if(n===Mh)return i.RGB;if(n===Ke)return i.RGBA;if(n===ai)return i.DEPTH_COMPONENT;if(n===hi)return i.DEPTH_STENCIL;if(n===bh)return i.RED;if(n===Ma)return i.RED_INTEGER;if(n===Ni)return i.RG;if(n===ba)return i.RG_INTEGER;if(n===Sa)return i.RGBA_INTEGER;if(n===Lr||n===Dr||n===Nr||n===Or)if(o===oe)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===Lr)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===Dr)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===Nr)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===Or)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===Lr)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===Dr)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===Nr)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===Or)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===wa||n===Ta||n===Ea||n===Aa)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===wa)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===Ta)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===Ea)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===Aa)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===Ca||n===Ra||n===Pa||n===Ia||n===La||n===Ur||n===Da)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(n===Ca||n===Ra)return o===oe?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===Pa)return o===oe?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(n===Ia)return r.COMPRESSED_R11_EAC;if(n===La)return r.COMPRESSED_SIGNED_R11_EAC;if(n===Ur)return r.COMPRESSED_RG11_EAC;if(n===Da)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(n===Na||n===Oa||n===Ua||n===Fa||n===Ba||n===ka||n===za||n===Ga||n===Va||n===Ha||n===Wa||n===Xa||n===qa||n===$a)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(n===Na)return o===oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===Oa)return o===oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===Ua)return o===oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===Fa)return o===oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===Ba)return o===oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===ka)return o===oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===za)return o===oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===Ga)return o===oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===Va)return o===oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===Ha)return o===oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===Wa)return o===oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===Xa)return o===oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===qa)return o===oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===$a)return o===oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===Ya||n===Za||n===Ja)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(n===Ya)return o===oe?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===Za)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===Ja)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===Ka||n===ja||n===Fr||n===Qa)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(n===Ka)return r.COMPRESSED_RED_RGTC1_EXT;if(n===ja)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===Fr)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===Qa)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===Ki?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:e}}var LM=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,DM=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,Wh=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e){if(this.texture===null){let n=new yr(t.texture);(t.depthNear!==e.depthNear||t.depthFar!==e.depthFar)&&(this.depthNear=t.depthNear,this.depthFar=t.depthFar),this.texture=n}}getMesh(t){if(this.texture!==null&&this.mesh===null){let e=t.cameras[0].viewport,n=new Hn({vertexShader:LM,fragmentShader:DM,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new en(new Tr(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},Xh=class extends Pn{constructor(t,e){super();let n=this,s=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,u=null,d=null,f=null,m=null,x=typeof XRWebGLBinding<"u",p=new Wh,g={},S=e.getContextAttributes(),w=null,b=null,C=[],A=[],_=new Dt,T=null,F=null,L=new $e;L.viewport=new _e;let N=new $e;N.viewport=new _e;let z=[L,N],Y=new pa,I=null,X=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(J){let pt=C[J];return pt===void 0&&(pt=new ws,C[J]=pt),pt.getTargetRaySpace()},this.getControllerGrip=function(J){let pt=C[J];return pt===void 0&&(pt=new ws,C[J]=pt),pt.getGripSpace()},this.getHand=function(J){let pt=C[J];return pt===void 0&&(pt=new ws,C[J]=pt),pt.getHandSpace()};function $(J){let pt=A.indexOf(J.inputSource);if(pt===-1)return;let yt=C[pt];yt!==void 0&&(yt.update(J.inputSource,J.frame,c||o),yt.dispatchEvent({type:J.type,data:J.inputSource}))}function V(){s.removeEventListener("select",$),s.removeEventListener("selectstart",$),s.removeEventListener("selectend",$),s.removeEventListener("squeeze",$),s.removeEventListener("squeezestart",$),s.removeEventListener("squeezeend",$),s.removeEventListener("end",V),s.removeEventListener("inputsourceschange",it);for(let J=0;J<C.length;J++){let pt=A[J];pt!==null&&(A[J]=null,C[J].disconnect(pt))}I=null,X=null,p.reset();for(let J in g)delete g[J];if(t.setRenderTarget(w),f=null,d=null,u=null,s=null,b=null,It.stop(),n.isPresenting=!1,t.setPixelRatio(T),t.setSize(_.width,_.height,!1),F!==null){let J=F.camera;J.fov=F.fov,J.zoom=F.zoom,J.updateProjectionMatrix(),F=null}n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(J){r=J,n.isPresenting===!0&&Nt("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(J){a=J,n.isPresenting===!0&&Nt("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(J){c=J},this.getBaseLayer=function(){return d!==null?d:f},this.getBinding=function(){return u===null&&x&&(u=new XRWebGLBinding(s,e)),u},this.getFrame=function(){return m},this.getSession=function(){return s},this.setSession=async function(J){if(s=J,s!==null){if(w=t.getRenderTarget(),s.addEventListener("select",$),s.addEventListener("selectstart",$),s.addEventListener("selectend",$),s.addEventListener("squeeze",$),s.addEventListener("squeezestart",$),s.addEventListener("squeezeend",$),s.addEventListener("end",V),s.addEventListener("inputsourceschange",it),S.xrCompatible!==!0&&await e.makeXRCompatible(),T=t.getPixelRatio(),t.getSize(_),x&&"createProjectionLayer"in XRWebGLBinding.prototype){let yt=null,Ct=null,gt=null;S.depth&&(gt=S.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,yt=S.stencil?hi:ai,Ct=S.stencil?Ki:Ln);let Ut={colorFormat:e.RGBA8,depthFormat:gt,scaleFactor:r};u=this.getBinding(),d=u.createProjectionLayer(Ut),s.updateRenderState({layers:[d]}),t.setPixelRatio(1),t.setSize(d.textureWidth,d.textureHeight,!1),b=new hn(d.textureWidth,d.textureHeight,{format:Ke,type:Je,depthTexture:new li(d.textureWidth,d.textureHeight,Ct,void 0,void 0,void 0,void 0,void 0,void 0,yt),stencilBuffer:S.stencil,colorSpace:t.outputColorSpace,samples:S.antialias?4:0,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}else{let yt={antialias:S.antialias,alpha:!0,depth:S.depth,stencil:S.stencil,framebufferScaleFactor:r};f=new XRWebGLLayer(s,e,yt),s.updateRenderState({baseLayer:f}),t.setPixelRatio(1),t.setSize(f.framebufferWidth,f.framebufferHeight,!1),b=new hn(f.framebufferWidth,f.framebufferHeight,{format:Ke,type:Je,colorSpace:t.outputColorSpace,stencilBuffer:S.stencil,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}b.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),It.setContext(s),It.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return p.getDepthTexture()};function it(J){for(let pt=0;pt<J.removed.length;pt++){let yt=J.removed[pt],Ct=A.indexOf(yt);Ct>=0&&(A[Ct]=null,C[Ct].disconnect(yt))}for(let pt=0;pt<J.added.length;pt++){let yt=J.added[pt],Ct=A.indexOf(yt);if(Ct===-1){for(let Ut=0;Ut<C.length;Ut++)if(Ut>=A.length){A.push(yt),Ct=Ut;break}else if(A[Ut]===null){A[Ut]=yt,Ct=Ut;break}if(Ct===-1)break}let gt=C[Ct];gt&&gt.connect(yt)}}function W(J,pt){pt===null?J.matrixWorld.copy(J.matrix):J.matrixWorld.multiplyMatrices(pt.matrixWorld,J.matrix),J.matrixWorldInverse.copy(J.matrixWorld).invert()}this.updateCamera=function(J){if(s===null)return;let pt=J.near,yt=J.far;p.texture!==null&&(p.depthNear>0&&(pt=p.depthNear),p.depthFar>0&&(yt=p.depthFar)),Y.near=N.near=L.near=pt,Y.far=N.far=L.far=yt,(I!==Y.near||X!==Y.far)&&(s.updateRenderState({depthNear:Y.near,depthFar:Y.far}),I=Y.near,X=Y.far),Y.layers.mask=J.layers.mask|6,L.layers.mask=Y.layers.mask&-5,N.layers.mask=Y.layers.mask&-3;let Ct=J.parent,gt=Y.cameras;W(Y,Ct);for(let Ut=0;Ut<gt.length;Ut++)W(gt[Ut],Ct);Y.projectionMatrix.copy(L.projectionMatrix),Y.projectionMatrixInverse.copy(L.projectionMatrixInverse),F===null&&J.isPerspectiveCamera&&(F={camera:J,fov:J.fov,zoom:J.zoom}),tt(J,Y,Ct)};function tt(J,pt,yt){yt===null?J.matrix.copy(pt.matrixWorld):(J.matrix.copy(yt.matrixWorld),J.matrix.invert(),J.matrix.multiply(pt.matrixWorld)),J.matrix.decompose(J.position,J.quaternion,J.scale),J.updateMatrixWorld(!0),J.projectionMatrix.copy(pt.projectionMatrix),J.projectionMatrixInverse.copy(pt.projectionMatrixInverse),J.isPerspectiveCamera&&(J.fov=Ms*2*Math.atan(1/J.projectionMatrix.elements[5]),J.zoom=1)}this.getCamera=function(){return Y},this.getFoveation=function(){if(!(d===null&&f===null))return l},this.setFoveation=function(J){l=J,d!==null&&(d.fixedFoveation=J),f!==null&&f.fixedFoveation!==void 0&&(f.fixedFoveation=J)},this.hasDepthSensing=function(){return p.texture!==null},this.getDepthSensingMesh=function(){return p.getMesh(Y)},this.getCameraTexture=function(J){return g[J]};let et=null;function Mt(J,pt){if(h=pt.getViewerPose(c||o),m=pt,h!==null){let yt=h.views;f!==null&&(t.setRenderTargetFramebuffer(b,f.framebuffer),t.setRenderTarget(b));let Ct=!1;yt.length!==Y.cameras.length&&(Y.cameras.length=0,Ct=!0);for(let Pt=0;Pt<yt.length;Pt++){let te=yt[Pt],re=null;if(f!==null)re=f.getViewport(te);else{let Ue=u.getViewSubImage(d,te);re=Ue.viewport,Pt===0&&(t.setRenderTargetTextures(b,Ue.colorTexture,Ue.depthStencilTexture),t.setRenderTarget(b))}let Yt=z[Pt];Yt===void 0&&(Yt=new $e,Yt.layers.enable(Pt),Yt.viewport=new _e,z[Pt]=Yt),Yt.matrix.fromArray(te.transform.matrix),Yt.matrix.decompose(Yt.position,Yt.quaternion,Yt.scale),Yt.projectionMatrix.fromArray(te.projectionMatrix),Yt.projectionMatrixInverse.copy(Yt.projectionMatrix).invert(),Yt.viewport.set(re.x,re.y,re.width,re.height),Pt===0&&(Y.matrix.copy(Yt.matrix),Y.matrix.decompose(Y.position,Y.quaternion,Y.scale)),Ct===!0&&Y.cameras.push(Yt)}let gt=s.enabledFeatures;if(gt&&gt.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&x){u=n.getBinding();let Pt=u.getDepthInformation(yt[0]);Pt&&Pt.isValid&&Pt.texture&&p.init(Pt,s.renderState)}if(gt&&gt.includes("camera-access")&&x){t.state.unbindTexture(),u=n.getBinding();for(let Pt=0;Pt<yt.length;Pt++){let te=yt[Pt].camera;if(te){let re=g[te];re||(re=new yr,g[te]=re);let Yt=u.getCameraImage(te);re.sourceTexture=Yt}}}}for(let yt=0;yt<C.length;yt++){let Ct=A[yt],gt=C[yt];Ct!==null&&gt!==void 0&&gt.update(Ct,pt,c||o)}et&&et(J,pt),pt.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:pt}),m=null}let It=new up;It.setAnimationLoop(Mt),this.setAnimationLoop=function(J){et=J},this.dispose=function(){}}},NM=new Qt,Mp=new Ft;Mp.set(-1,0,0,0,1,0,0,0,1);function OM(i,t){function e(p,g){p.matrixAutoUpdate===!0&&p.updateMatrix(),g.value.copy(p.matrix)}function n(p,g){g.color.getRGB(p.fogColor.value,Lh(i)),g.isFog?(p.fogNear.value=g.near,p.fogFar.value=g.far):g.isFogExp2&&(p.fogDensity.value=g.density)}function s(p,g,S,w,b){g.isNodeMaterial?g.uniformsNeedUpdate=!1:g.isMeshBasicMaterial?r(p,g):g.isMeshLambertMaterial?(r(p,g),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)):g.isMeshToonMaterial?(r(p,g),u(p,g)):g.isMeshPhongMaterial?(r(p,g),h(p,g),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)):g.isMeshStandardMaterial?(r(p,g),d(p,g),g.isMeshPhysicalMaterial&&f(p,g,b)):g.isMeshMatcapMaterial?(r(p,g),m(p,g)):g.isMeshDepthMaterial?r(p,g):g.isMeshDistanceMaterial?(r(p,g),x(p,g)):g.isMeshNormalMaterial?r(p,g):g.isLineBasicMaterial?(o(p,g),g.isLineDashedMaterial&&a(p,g)):g.isPointsMaterial?l(p,g,S,w):g.isSpriteMaterial?c(p,g):g.isShadowMaterial?(p.color.value.copy(g.color),p.opacity.value=g.opacity):g.isShaderMaterial&&(g.uniformsNeedUpdate=!1)}function r(p,g){p.opacity.value=g.opacity,g.color&&p.diffuse.value.copy(g.color),g.emissive&&p.emissive.value.copy(g.emissive).multiplyScalar(g.emissiveIntensity),g.map&&(p.map.value=g.map,e(g.map,p.mapTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.bumpMap&&(p.bumpMap.value=g.bumpMap,e(g.bumpMap,p.bumpMapTransform),p.bumpScale.value=g.bumpScale,g.side===Be&&(p.bumpScale.value*=-1)),g.normalMap&&(p.normalMap.value=g.normalMap,e(g.normalMap,p.normalMapTransform),p.normalScale.value.copy(g.normalScale),g.side===Be&&p.normalScale.value.negate()),g.displacementMap&&(p.displacementMap.value=g.displacementMap,e(g.displacementMap,p.displacementMapTransform),p.displacementScale.value=g.displacementScale,p.displacementBias.value=g.displacementBias),g.emissiveMap&&(p.emissiveMap.value=g.emissiveMap,e(g.emissiveMap,p.emissiveMapTransform)),g.specularMap&&(p.specularMap.value=g.specularMap,e(g.specularMap,p.specularMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest);let S=t.get(g),w=S.envMap,b=S.envMapRotation;w&&(p.envMap.value=w,p.envMapRotation.value.setFromMatrix4(NM.makeRotationFromEuler(b)).transpose(),w.isCubeTexture&&w.isRenderTargetTexture===!1&&p.envMapRotation.value.premultiply(Mp),p.reflectivity.value=g.reflectivity,p.ior.value=g.ior,p.refractionRatio.value=g.refractionRatio),g.lightMap&&(p.lightMap.value=g.lightMap,p.lightMapIntensity.value=g.lightMapIntensity,e(g.lightMap,p.lightMapTransform)),g.aoMap&&(p.aoMap.value=g.aoMap,p.aoMapIntensity.value=g.aoMapIntensity,e(g.aoMap,p.aoMapTransform))}function o(p,g){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,g.map&&(p.map.value=g.map,e(g.map,p.mapTransform))}function a(p,g){p.dashSize.value=g.dashSize,p.totalSize.value=g.dashSize+g.gapSize,p.scale.value=g.scale}function l(p,g,S,w){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,p.size.value=g.size*S,p.scale.value=w*.5,g.map&&(p.map.value=g.map,e(g.map,p.uvTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest)}function c(p,g){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,p.rotation.value=g.rotation,g.map&&(p.map.value=g.map,e(g.map,p.mapTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest)}function h(p,g){p.specular.value.copy(g.specular),p.shininess.value=Math.max(g.shininess,1e-4)}function u(p,g){g.gradientMap&&(p.gradientMap.value=g.gradientMap)}function d(p,g){p.metalness.value=g.metalness,g.metalnessMap&&(p.metalnessMap.value=g.metalnessMap,e(g.metalnessMap,p.metalnessMapTransform)),p.roughness.value=g.roughness,g.roughnessMap&&(p.roughnessMap.value=g.roughnessMap,e(g.roughnessMap,p.roughnessMapTransform)),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)}function f(p,g,S){p.ior.value=g.ior,g.diffuseRoughness>0&&(p.diffuseRoughness.value=g.diffuseRoughness,g.diffuseRoughnessMap&&(p.diffuseRoughnessMap.value=g.diffuseRoughnessMap,e(g.diffuseRoughnessMap,p.diffuseRoughnessMapTransform))),g.sheen>0&&(p.sheenColor.value.copy(g.sheenColor).multiplyScalar(g.sheen),p.sheenRoughness.value=g.sheenRoughness,g.sheenColorMap&&(p.sheenColorMap.value=g.sheenColorMap,e(g.sheenColorMap,p.sheenColorMapTransform)),g.sheenRoughnessMap&&(p.sheenRoughnessMap.value=g.sheenRoughnessMap,e(g.sheenRoughnessMap,p.sheenRoughnessMapTransform))),g.clearcoat>0&&(p.clearcoat.value=g.clearcoat,p.clearcoatRoughness.value=g.clearcoatRoughness,g.clearcoatMap&&(p.clearcoatMap.value=g.clearcoatMap,e(g.clearcoatMap,p.clearcoatMapTransform)),g.clearcoatRoughnessMap&&(p.clearcoatRoughnessMap.value=g.clearcoatRoughnessMap,e(g.clearcoatRoughnessMap,p.clearcoatRoughnessMapTransform)),g.clearcoatNormalMap&&(p.clearcoatNormalMap.value=g.clearcoatNormalMap,e(g.clearcoatNormalMap,p.clearcoatNormalMapTransform),p.clearcoatNormalScale.value.copy(g.clearcoatNormalScale),g.side===Be&&p.clearcoatNormalScale.value.negate())),g.dispersion>0&&(p.dispersion.value=g.dispersion),g.retroreflectivity>0&&(p.retroreflectivity.value=g.retroreflectivity),g.iridescence>0&&(p.iridescence.value=g.iridescence,p.iridescenceIOR.value=g.iridescenceIOR,p.iridescenceThicknessMinimum.value=g.iridescenceThicknessMinimum,p.iridescenceThicknessMaximum.value=g.iridescenceThicknessMaximum,g.iridescenceMap&&(p.iridescenceMap.value=g.iridescenceMap,e(g.iridescenceMap,p.iridescenceMapTransform)),g.iridescenceThicknessMap&&(p.iridescenceThicknessMap.value=g.iridescenceThicknessMap,e(g.iridescenceThicknessMap,p.iridescenceThicknessMapTransform))),g.transmission>0&&(p.transmission.value=g.transmission,p.transmissionSamplerMap.value=S.texture,p.transmissionSamplerSize.value.set(S.width,S.height),g.transmissionMap&&(p.transmissionMap.value=g.transmissionMap,e(g.transmissionMap,p.transmissionMapTransform)),p.thickness.value=g.thickness,g.thicknessMap&&(p.thicknessMap.value=g.thicknessMap,e(g.thicknessMap,p.thicknessMapTransform)),p.attenuationDistance.value=g.attenuationDistance,p.attenuationColor.value.copy(g.attenuationColor)),g.anisotropy>0&&(p.anisotropyVector.value.set(g.anisotropy*Math.cos(g.anisotropyRotation),g.anisotropy*Math.sin(g.anisotropyRotation)),g.anisotropyMap&&(p.anisotropyMap.value=g.anisotropyMap,e(g.anisotropyMap,p.anisotropyMapTransform))),p.specularIntensity.value=g.specularIntensity,p.specularColor.value.copy(g.specularColor),g.specularColorMap&&(p.specularColorMap.value=g.specularColorMap,e(g.specularColorMap,p.specularColorMapTransform)),g.specularIntensityMap&&(p.specularIntensityMap.value=g.specularIntensityMap,e(g.specularIntensityMap,p.specularIntensityMapTransform))}function m(p,g){g.matcap&&(p.matcap.value=g.matcap)}function x(p,g){let S=t.get(g).light;p.referencePosition.value.setFromMatrixPosition(S.matrixWorld),p.nearDistance.value=S.shadow.camera.near,p.farDistance.value=S.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function UM(i,t,e,n){let s={},r={};function o(S,w){let b=w.program;n.uniformBlockBinding(S,b,s[S.id])}function a(S,w){let b=s[S.id];b===void 0&&(m(S),b=l(S),s[S.id]=b,S.addEventListener("dispose",p));let C=w.program;n.updateUBOMapping(S,C);let A=t.render.frame;r[S.id]!==A&&(c(S),r[S.id]=A)}function l(S){let w=i.createBuffer(),b=S.__size,C=S.usage;return i.bindBuffer(i.UNIFORM_BUFFER,w),i.bufferData(i.UNIFORM_BUFFER,b,C),i.bindBuffer(i.UNIFORM_BUFFER,null),w}function c(S){let w=s[S.id],b=S.uniforms,C=S.__cache;i.bindBuffer(i.UNIFORM_BUFFER,w);for(let A=0,_=b.length;A<_;A++){let T=b[A];if(Array.isArray(T))for(let F=0,L=T.length;F<L;F++)h(T[F],A,F,C);else h(T,A,0,C)}i.bindBuffer(i.UNIFORM_BUFFER,null)}function h(S,w,b,C){if(d(S,w,b,C)===!0){let A=S.__offset,_=S.value;if(Array.isArray(_)){let T=0;for(let F=0;F<_.length;F++){let L=_[F],N=x(L,!0);u(L,S.__data,T),T+=N.storage/Float32Array.BYTES_PER_ELEMENT}}else u(_,S.__data,0);i.bufferSubData(i.UNIFORM_BUFFER,A,S.__data)}}function u(S,w,b){typeof S=="number"||typeof S=="boolean"?w[b]=S:S.isMatrix3?(w[b]=S.elements[0],w[b+1]=S.elements[1],w[b+2]=S.elements[2],w[b+3]=0,w[b+4]=S.elements[3],w[b+5]=S.elements[4],w[b+6]=S.elements[5],w[b+7]=0,w[b+8]=S.elements[6],w[b+9]=S.elements[7],w[b+10]=S.elements[8],w[b+11]=0):ArrayBuffer.isView(S)?w.set(S.subarray(0,w.length-b),b):S.toArray(w,b)}function d(S,w,b,C){let A=S.value,_=w+"_"+b;if(Array.isArray(A)){C[_]===void 0&&(C[_]=[]);let T=C[_],F=!1;for(let L=0;L<A.length;L++)f(A[L],T,L)===!0&&(F=!0);return F}return f(A,C,_)}function f(S,w,b){if(w[b]===void 0)return typeof S=="number"||typeof S=="boolean"?w[b]=S:ArrayBuffer.isView(S)?w[b]=S.slice():w[b]=S.clone(),!0;{let C=w[b];if(typeof S=="number"||typeof S=="boolean"){if(C!==S)return w[b]=S,!0}else{if(ArrayBuffer.isView(S))return!0;if(C.equals(S)===!1)return C.copy(S),!0}}return!1}function m(S){let w=S.uniforms,b=0,C=16;for(let _=0,T=w.length;_<T;_++){let F=Array.isArray(w[_])?w[_]:[w[_]];for(let L=0,N=F.length;L<N;L++){let z=F[L],Y=Array.isArray(z.value)?z.value:[z.value],I=Array.isArray(w[_])||Array.isArray(z.value),X=b;for(let V=0,it=Y.length;V<it;V++){let W=Y[V],tt=x(W,I),et=b%C,Mt=et%tt.boundary,It=et+Mt;b+=Mt,It!==0&&C-It<tt.storage&&(b+=C-It),V===0&&(X=b),b+=tt.storage}let $=z.type==="int"?Int32Array:z.type==="uint"?Uint32Array:Float32Array;z.__data=new $((b-X)/Float32Array.BYTES_PER_ELEMENT),z.__offset=X}}let A=b%C;return A>0&&(b+=C-A),S.__size=b,S.__cache={},this}function x(S,w){let b={boundary:0,storage:0};return typeof S=="number"||typeof S=="boolean"?(b.boundary=4,b.storage=4):S.isVector2?(b.boundary=8,b.storage=8):S.isVector3||S.isColor?(b.boundary=16,b.storage=12):S.isVector4?(b.boundary=16,b.storage=16):S.isMatrix3?(b.boundary=16,b.storage=48):S.isMatrix4?(b.boundary=16,b.storage=64):S.isTexture?Nt("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(S)?(b.boundary=16,b.storage=S.byteLength):Nt("WebGLRenderer: Unsupported uniform value type.",S),w===!0&&(b.boundary=16,b.storage=Math.ceil(b.storage/16)*16),b}function p(S){let w=S.target;w.removeEventListener("dispose",p),i.deleteBuffer(s[w.id]),delete s[w.id],delete r[w.id]}function g(){for(let S in s)i.deleteBuffer(s[S]);s={},r={}}return{bind:o,update:a,dispose:g}}var FM=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),$n=null;function BM(){return $n===null&&($n=new Ei(FM,16,16,Ni,Dn),$n.name="DFG_LUT",$n.minFilter=Ze,$n.magFilter=Ze,$n.wrapS=zn,$n.wrapT=zn,$n.generateMipmaps=!1,$n.needsUpdate=!0),$n}var il=class{constructor(t={}){let{canvas:e=Pf(),context:n=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:d=!1,outputBufferType:f=Je}=t;this.isWebGLRenderer=!0;let m;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");m=n.getContextAttributes().alpha}else m=o;let x=f,p=new Set([Sa,ba,Ma]),g=new Set([Je,Ln,Ls,Ki,va,ya]),S=new Uint32Array(4),w=new Int32Array(4),b={textures:[],min:[],max:[],resolution:[]},C=null,A=null,_=[],T=[],F=null;this.domElement=e,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=qn,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let L=this,N=!1,z=null,Y=null,I=null,X=null;this._outputColorSpace=ln;let $=0,V=0,it=null,W=-1,tt=null,et=new _e,Mt=new _e,It=null,J=new Bt(0),pt=0,yt=e.width,Ct=e.height,gt=1,Ut=null,xe=null,Pt=new _e(0,0,yt,Ct),te=new _e(0,0,yt,Ct),re=!1,Yt=new qi,Ue=new Qo,Ee=!1,je=!1,pe=new Qt,Bn=new O,Ie=new _e,gn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},_n=!1;function xn(){return it===null?gt:1}let D=n;function vn(y,P){return e.getContext(y,P)}let de,fe,mt,Ae,Lt,kt,E,v,B,st,Q,at,dt,Z,K,ct,R,j,q,ht,ot,lt,At;try{let y={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${"187"}`),e.addEventListener("webglcontextlost",Rt,!1),e.addEventListener("webglcontextrestored",Ht,!1),e.addEventListener("webglcontextcreationerror",_t,!1),D===null){let P="webgl2";if(D=vn(P,y),D===null)throw vn(P)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}Wt()}catch(y){throw e.removeEventListener("webglcontextlost",Rt,!1),e.removeEventListener("webglcontextrestored",Ht,!1),e.removeEventListener("webglcontextcreationerror",_t,!1),Ot("WebGLRenderer: "+y.message),y}function Wt(){de=new Zv(D),de.init(),ot=new IM(D,de),fe=new Bv(D,de,t,ot),mt=new RM(D,de),fe.reversedDepthBuffer&&d&&mt.buffers.depth.setReversed(!0),Y=D.createFramebuffer(),I=D.createFramebuffer(),X=D.createFramebuffer(),Ae=new jv(D),Lt=new mM,kt=new PM(D,de,mt,Lt,fe,ot,Ae),E=new Yv(L),v=new t_(D),lt=new Uv(D,v),B=new Jv(D,v,Ae,lt),st=new ty(D,B,v,lt,Ae),j=new Qv(D,fe,kt),K=new kv(Lt),Q=new pM(L,E,de,fe,lt,K),at=new OM(L,Lt),dt=new _M,Z=new SM(de),R=new Ov(L,E,mt,st,m,l),ct=new CM(L,st,fe),At=new UM(D,Ae,fe,mt),q=new Fv(D,de,Ae),ht=new Kv(D,de,Ae),Ae.programs=Q.programs,L.capabilities=fe,L.extensions=de,L.properties=Lt,L.renderLists=dt,L.shadowMap=ct,L.state=mt,L.info=Ae}x!==Je&&(F=new ny(x,e.width,e.height,a,s,r));let rt=new Xh(L,D);this.xr=rt,this.getContext=function(){return D},this.getContextAttributes=function(){return D.getContextAttributes()},this.forceContextLoss=function(){let y=de.get("WEBGL_lose_context");y&&y.loseContext()},this.forceContextRestore=function(){let y=de.get("WEBGL_lose_context");y&&y.restoreContext()},this.getPixelRatio=function(){return gt},this.setPixelRatio=function(y){y!==void 0&&(gt=y,this.setSize(yt,Ct,!1))},this.getSize=function(y){return y.set(yt,Ct)},this.setSize=function(y,P,G=!0){if(rt.isPresenting){Nt("WebGLRenderer: Can't change size while VR device is presenting.");return}yt=y,Ct=P,e.width=Math.floor(y*gt),e.height=Math.floor(P*gt),G===!0&&(e.style.width=y+"px",e.style.height=P+"px"),F!==null&&F.setSize(e.width,e.height),this.setViewport(0,0,y,P)},this.getDrawingBufferSize=function(y){return y.set(yt*gt,Ct*gt).floor()},this.setDrawingBufferSize=function(y,P,G){yt=y,Ct=P,gt=G,e.width=Math.floor(y*G),e.height=Math.floor(P*G),this.setViewport(0,0,y,P)},this.setEffects=function(y){if(x===Je){Ot("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(y){for(let P=0;P<y.length;P++)if(y[P].isOutputPass===!0){Nt("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}F.setEffects(y||[])},this.getCurrentViewport=function(y){return y.copy(et)},this.getViewport=function(y){return y.copy(Pt)},this.setViewport=function(y,P,G,U){y.isVector4?Pt.set(y.x,y.y,y.z,y.w):Pt.set(y,P,G,U),mt.viewport(et.copy(Pt).multiplyScalar(xn()).round())},this.getScissor=function(y){return y.copy(te)},this.setScissor=function(y,P,G,U){y.isVector4?te.set(y.x,y.y,y.z,y.w):te.set(y,P,G,U),mt.scissor(Mt.copy(te).multiplyScalar(xn()).round())},this.getScissorTest=function(){return re},this.setScissorTest=function(y){mt.setScissorTest(re=y)},this.setOpaqueSort=function(y){Ut=y},this.setTransparentSort=function(y){xe=y},this.getClearColor=function(y){return y.copy(R.getClearColor())},this.setClearColor=function(){R.setClearColor(...arguments)},this.getClearAlpha=function(){return R.getClearAlpha()},this.setClearAlpha=function(){R.setClearAlpha(...arguments)},this.clear=function(y=!0,P=!0,G=!0){let U=0;if(y){let k=!1;if(it!==null){let ft=it.texture.format;k=p.has(ft)}if(k){let ft=it.texture.type,bt=g.has(ft),ut=R.getClearColor(),vt=R.getClearAlpha(),Et=ut.r,zt=ut.g,Zt=ut.b;bt?(S[0]=Et,S[1]=zt,S[2]=Zt,S[3]=vt,D.clearBufferuiv(D.COLOR,0,S)):(w[0]=Et,w[1]=zt,w[2]=Zt,w[3]=vt,D.clearBufferiv(D.COLOR,0,w))}else U|=D.COLOR_BUFFER_BIT}P&&(U|=D.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),G&&(U|=D.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),U!==0&&D.clear(U)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(y){y.setRenderer(this),z=y},this.dispose=function(){e.removeEventListener("webglcontextlost",Rt,!1),e.removeEventListener("webglcontextrestored",Ht,!1),e.removeEventListener("webglcontextcreationerror",_t,!1),R.dispose(),dt.dispose(),Z.dispose(),kt.dispose(),Lt.dispose(),E.dispose(),st.dispose(),B.dispose(),lt.dispose(),At.dispose(),Q.dispose(),rt.dispose(),rt.removeEventListener("sessionstart",Ku),rt.removeEventListener("sessionend",ju),Bi.stop()};function Rt(y){y.preventDefault(),Ah("WebGLRenderer: Context Lost."),N=!0}function Ht(){Ah("WebGLRenderer: Context Restored."),N=!1;let y=Ae.autoReset,P=ct.enabled,G=ct.autoUpdate,U=ct.needsUpdate,k=ct.type;Wt(),Ae.autoReset=y,ct.enabled=P,ct.autoUpdate=G,ct.needsUpdate=U,ct.type=k}function _t(y){Ot("WebGLRenderer: A WebGL context could not be created. Reason: ",y.statusMessage)}function ae(y){let P=y.target;P.removeEventListener("dispose",ae),Le(P)}function Le(y){pi(y),Lt.remove(y)}function pi(y){let P=Lt.get(y).programs;P!==void 0&&(P.forEach(function(G){Q.releaseProgram(G)}),y.isShaderMaterial&&Q.releaseShaderCache(y))}this.renderBufferDirect=function(y,P,G,U,k,ft){P===null&&(P=gn);let bt=k.isMesh&&k.matrixWorld.determinantAffine()<0,ut=vg(y,P,G,U,k);mt.setMaterial(U,bt);let vt=G.index,Et=1;if(U.wireframe===!0){if(vt=B.getWireframeAttribute(G),vt===void 0)return;Et=2}let zt=G.drawRange,Zt=G.attributes.position,St=zt.start*Et,Jt=(zt.start+zt.count)*Et;ft!==null&&(St=Math.max(St,ft.start*Et),Jt=Math.min(Jt,(ft.start+ft.count)*Et)),vt!==null?(St=Math.max(St,0),Jt=Math.min(Jt,vt.count)):Zt!=null&&(St=Math.max(St,0),Jt=Math.min(Jt,Zt.count));let Se=Jt-St;if(Se<0||Se===1/0)return;lt.setup(k,U,ut,G,vt);let ce,le=q;if(vt!==null&&(ce=v.get(vt),le=ht,le.setIndex(ce)),k.isMesh)U.wireframe===!0?(mt.setLineWidth(U.wireframeLinewidth*xn()),le.setMode(D.LINES)):le.setMode(D.TRIANGLES);else if(k.isLine){let ze=U.linewidth;ze===void 0&&(ze=1),mt.setLineWidth(ze*xn()),k.isLineSegments?le.setMode(D.LINES):k.isLineLoop?le.setMode(D.LINE_LOOP):le.setMode(D.LINE_STRIP)}else k.isPoints?le.setMode(D.POINTS):k.isSprite&&le.setMode(D.TRIANGLES);if(k.isBatchedMesh)if(de.get("WEBGL_multi_draw"))le.renderMultiDraw(k._multiDrawStarts,k._multiDrawCounts,k._multiDrawCount);else{let ze=k._multiDrawStarts,wt=k._multiDrawCounts,Xe=k._multiDrawCount,ne=vt?v.get(vt).bytesPerElement:1,ki=Lt.get(U).currentProgram.getUniforms();for(let Ge=0;Ge<Xe;Ge++)ki.setValue(D,"_gl_DrawID",Ge),le.render(ze[Ge]/ne,wt[Ge])}else if(k.isInstancedMesh)le.renderInstances(St,Se,k.count);else if(G.isInstancedBufferGeometry){let ze=G._maxInstanceCount!==void 0?G._maxInstanceCount:1/0,wt=Math.min(G.instanceCount,ze);le.renderInstances(St,Se,wt)}else le.render(St,Se)};function Ju(y,P,G,U){z!==null&&y.isNodeMaterial&&z.setObject(U,y),Ee===!0&&K.setState(y,G,!1),y.transparent===!0&&y.side===Xn&&y.forceSinglePass===!1?(y.side=Be,y.needsUpdate=!0,Ks(y,P,U),y.side=Di,y.needsUpdate=!0,Ks(y,P,U),y.side=Xn):Ks(y,P,U)}this.compile=function(y,P,G=null){G===null&&(G=y),z!==null&&z.renderStart(y,P,G),A=Z.get(G),A.init(P),T.push(A),G.traverseVisible(function(k){k.isLight&&k.layers.test(P.layers)&&(A.pushLight(k),k.castShadow&&A.pushShadow(k))}),y!==G&&y.traverseVisible(function(k){k.isLight&&k.layers.test(P.layers)&&(A.pushLight(k),k.castShadow&&A.pushShadow(k))}),A.setupLights(),z!==null&&z.updateLights(A.state.lightsArray),je=this.localClippingEnabled,Ee=K.init(this.clippingPlanes,je),Ee===!0&&K.setGlobalState(this.clippingPlanes,P),z!==null&&ct.render(A.state.shadowsArray,G,P);let U=new Set;return y.traverse(function(k){if(!(k.isMesh||k.isPoints||k.isLine||k.isSprite))return;let ft=k.material;if(ft)if(Array.isArray(ft))for(let bt=0;bt<ft.length;bt++){let ut=ft[bt];Ju(ut,G,P,k),U.add(ut)}else Ju(ft,G,P,k),U.add(ft)}),A=T.pop(),z!==null&&z.renderEnd(),U},this.compileAsync=function(y,P,G=null){let U=this.compile(y,P,G);return new Promise(k=>{function ft(){if(U.forEach(function(bt){let vt=Lt.get(bt).currentProgram;(vt===void 0||vt.isReady())&&U.delete(bt)}),U.size===0){k(y);return}setTimeout(ft,10)}de.get("KHR_parallel_shader_compile")!==null?ft():setTimeout(ft,10)})};let pc=null;function _g(y){pc&&pc(y)}function Ku(){Bi.stop()}function ju(){Bi.start()}let Bi=new up;Bi.setAnimationLoop(_g),typeof self<"u"&&Bi.setContext(self),this.setAnimationLoop=function(y){pc=y,rt.setAnimationLoop(y),y===null?Bi.stop():Bi.start()},rt.addEventListener("sessionstart",Ku),rt.addEventListener("sessionend",ju),this.render=function(y,P){if(P!==void 0&&P.isCamera!==!0){Ot("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(N===!0)return;z!==null&&z.renderStart(y,P);let G=rt.enabled===!0&&rt.isPresenting===!0,U=F!==null&&(it===null||G)&&F.begin(L,it);if(y.matrixWorldAutoUpdate===!0&&y.updateMatrixWorld(),P.parent===null&&P.matrixWorldAutoUpdate===!0&&P.updateMatrixWorld(),rt.enabled===!0&&rt.isPresenting===!0&&(F===null||F.isCompositing()===!1)&&(rt.cameraAutoUpdate===!0&&rt.updateCamera(P),P=rt.getCamera()),y.isScene===!0&&y.onBeforeRender(L,y,P,it),A=Z.get(y,T.length),A.init(P),A.state.textureUnits=kt.getTextureUnits(),T.push(A),pe.multiplyMatrices(P.projectionMatrix,P.matrixWorldInverse),P.isArrayCamera?Ue.setFromArrayCamera(P):Yt.setFromProjectionMatrix(pe,Sn,P.reversedDepth),je=this.localClippingEnabled,Ee=K.init(this.clippingPlanes,je),C=dt.get(y,_.length),C.init(),_.push(C),this.info.render.frame++,rt.enabled===!0&&rt.isPresenting===!0){let bt=L.xr.getDepthSensingMesh();bt!==null&&mc(bt,P,-1/0,L.sortObjects)}mc(y,P,0,L.sortObjects),C.finish(),z!==null&&z.updateLights(A.state.lightsArray),L.sortObjects===!0&&C.sort(Ut,xe),_n=rt.enabled===!1||rt.isPresenting===!1||rt.hasDepthSensing()===!1,_n&&R.addToRenderList(C,y),this.info.autoReset===!0&&this.info.reset(),Ee===!0&&K.beginShadows();let k=A.state.shadowsArray;if(ct.render(k,y,P),Ee===!0&&K.endShadows(),(U&&F.hasRenderPass())===!1){let bt=C.opaque,ut=C.transmissive;if(A.setupLights(),P.isArrayCamera){let vt=P.cameras;if(ut.length>0)for(let Et=0,zt=vt.length;Et<zt;Et++){let Zt=vt[Et];td(bt,ut,y,Zt)}_n&&R.render(y);for(let Et=0,zt=vt.length;Et<zt;Et++){let Zt=vt[Et];Qu(C,y,Zt,Zt.viewport)}}else ut.length>0&&td(bt,ut,y,P),_n&&R.render(y),Qu(C,y,P)}it!==null&&V===0&&(kt.updateMultisampleRenderTarget(it),kt.updateRenderTargetMipmap(it)),U&&F.end(L),y.isScene===!0&&y.onAfterRender(L,y,P),lt.resetDefaultState(),W=-1,tt=null,T.pop(),T.length>0?(A=T[T.length-1],kt.setTextureUnits(A.state.textureUnits),Ee===!0&&K.setGlobalState(L.clippingPlanes,A.state.camera)):A=null,_.pop(),_.length>0?C=_[_.length-1]:C=null,z!==null&&z.renderEnd()};function mc(y,P,G,U){if(y.visible===!1)return;if(y.layers.test(P.layers)){if(y.isGroup)G=y.renderOrder;else if(y.isLOD)y.autoUpdate===!0&&y.update(P);else if(y.isLight)A.pushLight(y),y.castShadow&&A.pushShadow(y);else if(y.isSprite){let bt=P.isArrayCamera?Ue:Yt;if(!y.frustumCulled||y.intersectsFrustum(bt)){U&&Ie.setFromMatrixPosition(y.matrixWorld).applyMatrix4(pe);let ut=st.update(y),vt=y.material;vt.visible&&C.push(y,ut,vt,G,Ie.z,null,P)}}else if(y.isMesh||y.isLine||y.isPoints){let bt=P.isArrayCamera?Ue:Yt;if(!y.frustumCulled||y.intersectsFrustum(bt)){let ut=st.update(y),vt=y.material;if(U&&(y.boundingSphere!==void 0?(y.boundingSphere===null&&y.computeBoundingSphere(),Ie.copy(y.boundingSphere.center)):(ut.boundingSphere===null&&ut.computeBoundingSphere(),Ie.copy(ut.boundingSphere.center)),Ie.applyMatrix4(y.matrixWorld).applyMatrix4(pe)),Array.isArray(vt)){let Et=ut.groups;for(let zt=0,Zt=Et.length;zt<Zt;zt++){let St=Et[zt],Jt=vt[St.materialIndex];Jt&&Jt.visible&&C.push(y,ut,Jt,G,Ie.z,St,P)}}else vt.visible&&C.push(y,ut,vt,G,Ie.z,null,P)}}}let ft=y.children;for(let bt=0,ut=ft.length;bt<ut;bt++)mc(ft[bt],P,G,U)}function Qu(y,P,G,U){let{opaque:k,transmissive:ft,transparent:bt}=y;A.setupLightsView(G),Ee===!0&&K.setGlobalState(L.clippingPlanes,G),U&&mt.viewport(et.copy(U)),k.length>0&&ao(k,P,G),ft.length>0&&ao(ft,P,G),bt.length>0&&ao(bt,P,G),mt.buffers.depth.setTest(!0),mt.buffers.depth.setMask(!0),mt.buffers.color.setMask(!0),mt.setPolygonOffset(!1)}function td(y,P,G,U){if((G.isScene===!0?G.overrideMaterial:null)!==null)return;if(A.state.transmissionRenderTarget[U.id]===void 0){let St=de.has("EXT_color_buffer_half_float")||de.has("EXT_color_buffer_float");A.state.transmissionRenderTarget[U.id]=new hn(1,1,{generateMipmaps:!0,type:St?Dn:Je,minFilter:ci,samples:Math.max(4,fe.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:Kt.workingColorSpace})}let ft=A.state.transmissionRenderTarget[U.id],bt=U.viewport||et;ft.setSize(bt.z*L.transmissionResolutionScale,bt.w*L.transmissionResolutionScale);let ut=L.getRenderTarget(),vt=L.getActiveCubeFace(),Et=L.getActiveMipmapLevel();L.setRenderTarget(ft),L.getClearColor(J),pt=L.getClearAlpha(),pt<1&&L.setClearColor(16777215,.5),L.clear(),_n&&R.render(G);let zt=L.toneMapping;L.toneMapping=qn;let Zt=U.viewport;if(U.viewport!==void 0&&(U.viewport=void 0),A.setupLightsView(U),Ee===!0&&K.setGlobalState(L.clippingPlanes,U),ao(y,G,U),kt.updateMultisampleRenderTarget(ft),kt.updateRenderTargetMipmap(ft),de.has("WEBGL_multisampled_render_to_texture")===!1){let St=!1;for(let Jt=0,Se=P.length;Jt<Se;Jt++){let ce=P[Jt],{object:le,geometry:ze,material:wt,group:Xe}=ce;if(wt.side===Xn&&le.layers.test(U.layers)){let ne=wt.side;wt.side=Be,wt.needsUpdate=!0,ed(le,G,U,ze,wt,Xe),wt.side=ne,wt.needsUpdate=!0,St=!0}}St===!0&&(kt.updateMultisampleRenderTarget(ft),kt.updateRenderTargetMipmap(ft))}L.setRenderTarget(ut,vt,Et),L.setClearColor(J,pt),Zt!==void 0&&(U.viewport=Zt),L.toneMapping=zt}function ao(y,P,G){let U=P.isScene===!0?P.overrideMaterial:null;for(let k=0,ft=y.length;k<ft;k++){let bt=y[k],{object:ut,geometry:vt,group:Et}=bt,zt=bt.material;zt.allowOverride===!0&&U!==null&&(zt=U),ut.layers.test(G.layers)&&ed(ut,P,G,vt,zt,Et)}}function ed(y,P,G,U,k,ft){z!==null&&k.isNodeMaterial&&z.setObject(y,k),y.onBeforeRender(L,P,G,U,k,ft),y.modelViewMatrix.multiplyMatrices(G.matrixWorldInverse,y.matrixWorld),y.normalMatrix.getNormalMatrix(y.modelViewMatrix),k.onBeforeRender(L,P,G,U,y,ft),k.transparent===!0&&k.side===Xn&&k.forceSinglePass===!1?(k.side=Be,k.needsUpdate=!0,L.renderBufferDirect(G,P,U,k,y,ft),k.side=Di,k.needsUpdate=!0,L.renderBufferDirect(G,P,U,k,y,ft),k.side=Xn):L.renderBufferDirect(G,P,U,k,y,ft),y.onAfterRender(L,P,G,U,k,ft)}function nd(y){let P=0;for(let G of y)G.texture!==null&&P++;return P}function Ks(y,P,G){P.isScene!==!0&&(P=gn);let U=Lt.get(y),k=A.state.lights,ft=A.state.shadowsArray,bt=k.state.version,ut=Q.getParameters(y,k.state,ft,P,G,A.state.lightProbeGridArray),vt=Q.getProgramCacheKey(ut),Et=U.programs;U.environment=y.isMeshStandardMaterial||y.isMeshLambertMaterial||y.isMeshPhongMaterial?P.environment:null,U.fog=P.fog;let zt=y.isMeshStandardMaterial||y.isMeshLambertMaterial&&!y.envMap||y.isMeshPhongMaterial&&!y.envMap;U.envMap=E.get(y.envMap||U.environment,zt),U.envMapRotation=U.environment!==null&&y.envMap===null?P.environmentRotation:y.envMapRotation,Et===void 0&&(y.addEventListener("dispose",ae),Et=new Map,U.programs=Et,U.programVariants=new Map);let Zt=Et.get(vt);if(Zt!==void 0){if(U.currentProgram===Zt&&U.lightsStateVersion===bt)return sd(y,ut),Zt}else ut.uniforms=Q.getUniforms(y),z!==null&&y.isNodeMaterial&&z.build(y,G,ut),y.onBeforeCompile(ut,L),Zt=Q.acquireProgram(ut,vt),Et.set(vt,Zt),U.uniforms=ut.uniforms;let St=U.uniforms;return(!y.isShaderMaterial&&!y.isRawShaderMaterial||y.clipping===!0)&&(St.clippingPlanes=K.uniform),sd(y,ut),U.needsLights=Mg(y),U.lightsStateVersion=bt,U.needsLights&&(St.ambientLightColor.value=k.state.ambient,St.lightProbe.value=k.state.probe,St.sunLights.value=k.state.sun,St.sunLightShadows.value=k.state.sunShadow,St.directionalLights.value=k.state.directional,St.directionalLightShadows.value=k.state.directionalShadow,St.spotLights.value=k.state.spot,St.spotLightShadows.value=k.state.spotShadow,St.rectAreaLights.value=k.state.rectArea,St.ltc_1.value=k.state.rectAreaLTC1,St.ltc_2.value=k.state.rectAreaLTC2,St.pointLights.value=k.state.point,St.pointLightShadows.value=k.state.pointShadow,St.hemisphereLights.value=k.state.hemi,St.sunShadowMatrix.value=k.state.sunShadowMatrix,St.sunShadowCascade.value=k.state.sunShadowCascade,St.directionalShadowMatrix.value=k.state.directionalShadowMatrix,St.spotLightMatrix.value=k.state.spotLightMatrix,St.spotLightMap.value=k.state.spotLightMap,St.pointShadowMatrix.value=k.state.pointShadowMatrix),U.numLightProbeGrids=nd(A.state.lightProbeGridArray),U.currentProgram=Zt,U.uniformsList=null,Zt}function xg(y,P,G,U,k){let ft=Lt.get(y),bt=ft.currentProgram.id+","+U+","+k,ut=ft.programVariants.get(bt);return ut===void 0?(ut=Ks(y,P,G),ft.programVariants.set(bt,ut)):(ft.currentProgram=ut,ft.uniformsList=null,ft.outputColorSpace=U,ft.toneMapping=k),ut}function id(y){if(y.uniformsList===null){let P=y.currentProgram.getUniforms();y.uniformsList=Ns.seqWithValue(P.seq,y.uniforms)}return y.uniformsList}function sd(y,P){let G=Lt.get(y);G.outputColorSpace=P.outputColorSpace,G.batching=P.batching,G.batchingColor=P.batchingColor,G.instancing=P.instancing,G.instancingColor=P.instancingColor,G.instancingMorph=P.instancingMorph,G.skinning=P.skinning,G.morphTargets=P.morphTargets,G.morphNormals=P.morphNormals,G.morphColors=P.morphColors,G.morphTargetsCount=P.morphTargetsCount,G.numClippingPlanes=P.numClippingPlanes,G.numIntersection=P.numClipIntersection,G.vertexAlphas=P.vertexAlphas,G.vertexTangents=P.vertexTangents,G.toneMapping=P.toneMapping}function vg(y,P,G,U,k){P.isScene!==!0&&(P=gn),kt.resetTextureUnits();let ft=P.fog,bt=U.isMeshStandardMaterial||U.isMeshLambertMaterial||U.isMeshPhongMaterial?P.environment:null,ut=it===null?L.outputColorSpace:it.isXRRenderTarget===!0?it.texture.colorSpace:Kt.workingColorSpace,vt=U.isMeshStandardMaterial||U.isMeshLambertMaterial&&!U.envMap||U.isMeshPhongMaterial&&!U.envMap,Et=E.get(U.envMap||bt,vt),zt=U.vertexColors===!0&&!!G.attributes.color&&G.attributes.color.itemSize===4,Zt=!!G.attributes.tangent&&(!!U.normalMap||U.anisotropy>0),St=!!G.morphAttributes.position,Jt=!!G.morphAttributes.normal,Se=!!G.morphAttributes.color,ce=qn;U.toneMapped&&(it===null||it.isXRRenderTarget===!0)&&(ce=L.toneMapping);let le=G.morphAttributes.position||G.morphAttributes.normal||G.morphAttributes.color,ze=le!==void 0?le.length:0,wt=Lt.get(U),Xe=A.state.lights;if(Ee===!0&&(je===!0||y!==tt)){let me=y===tt&&U.id===W;K.setState(U,y,me)}let ne=!1,ki=!1;U.version===wt.__version?wt.needsLights&&wt.lightsStateVersion!==Xe.state.version||k.isBatchedMesh&&wt.batching===!1||!k.isBatchedMesh&&wt.batching===!0||k.isBatchedMesh&&wt.batchingColor===!0&&k._colorsTexture===null||k.isBatchedMesh&&wt.batchingColor===!1&&k._colorsTexture!==null||k.isInstancedMesh&&wt.instancing===!1||!k.isInstancedMesh&&wt.instancing===!0||k.isSkinnedMesh&&wt.skinning===!1||!k.isSkinnedMesh&&wt.skinning===!0||k.isInstancedMesh&&wt.instancingColor===!0&&k.instanceColor===null||k.isInstancedMesh&&wt.instancingColor===!1&&k.instanceColor!==null||k.isInstancedMesh&&wt.instancingMorph===!0&&k.morphTexture===null||k.isInstancedMesh&&wt.instancingMorph===!1&&k.morphTexture!==null||wt.envMap!==Et||U.fog===!0&&wt.fog!==ft||wt.numClippingPlanes!==void 0&&(wt.numClippingPlanes!==K.numPlanes||wt.numIntersection!==K.numIntersection)||wt.vertexAlphas!==zt||wt.vertexTangents!==Zt||wt.morphTargets!==St||wt.morphNormals!==Jt||wt.morphColors!==Se||wt.morphTargetsCount!==ze||wt.numLightProbeGrids!==nd(A.state.lightProbeGridArray)?ne=!0:(wt.outputColorSpace!==ut||wt.toneMapping!==ce)&&(ki=!0):(ne=!0,wt.__version=U.version);let Ge=wt.currentProgram;(ne===!0||ki===!0)&&(Ge=ki===!0?xg(U,P,k,ut,ce):Ks(U,P,k),z&&U.isNodeMaterial&&z.onUpdateProgram(U,Ge,wt));let lo=!1,mi=!1,zi=!1,jt=Ge.getUniforms(),Fe=wt.uniforms;if(mt.useProgram(Ge.program)&&(lo=!0,mi=!0,zi=!0),U.id!==W&&(W=U.id,mi=!0),lo||tt!==y){mt.buffers.depth.getReversed()&&y.reversedDepth!==!0&&(y._reversedDepth=!0,y.updateProjectionMatrix()),jt.setValue(D,"projectionMatrix",y.projectionMatrix),jt.setValue(D,"viewMatrix",y.matrixWorldInverse);let De=jt.map.cameraPosition;De!==void 0&&De.setValue(D,Bn.setFromMatrixPosition(y.matrixWorld)),fe.logarithmicDepthBuffer&&jt.setValue(D,"logDepthBufFC",2/(Math.log(y.far+1)/Math.LN2)),(U.isMeshPhongMaterial||U.isMeshToonMaterial||U.isMeshLambertMaterial||U.isMeshBasicMaterial||U.isMeshStandardMaterial||U.isShaderMaterial)&&jt.setValue(D,"isOrthographic",y.isOrthographicCamera===!0),tt!==y&&(tt=y,mi=!0,zi=!0)}if(wt.needsLights&&(Xe.state.sunShadowMap.length>0&&jt.setValue(D,"sunShadowMap",Xe.state.sunShadowMap,kt),Xe.state.directionalShadowMap.length>0&&jt.setValue(D,"directionalShadowMap",Xe.state.directionalShadowMap,kt),Xe.state.spotShadowMap.length>0&&jt.setValue(D,"spotShadowMap",Xe.state.spotShadowMap,kt),Xe.state.pointShadowMap.length>0&&jt.setValue(D,"pointShadowMap",Xe.state.pointShadowMap,kt)),k.isSkinnedMesh){jt.setOptional(D,k,"bindMatrix"),jt.setOptional(D,k,"bindMatrixInverse");let me=k.skeleton;me&&(me.boneTexture===null&&me.computeBoneTexture(),jt.setValue(D,"boneTexture",me.boneTexture,kt))}k.isBatchedMesh&&(jt.setOptional(D,k,"batchingTexture"),jt.setValue(D,"batchingTexture",k._matricesTexture,kt),jt.setOptional(D,k,"batchingIdTexture"),jt.setValue(D,"batchingIdTexture",k._indirectTexture,kt),jt.setOptional(D,k,"batchingColorTexture"),k._colorsTexture!==null&&jt.setValue(D,"batchingColorTexture",k._colorsTexture,kt));let Tn=G.morphAttributes;if((Tn.position!==void 0||Tn.normal!==void 0||Tn.color!==void 0)&&j.update(k,G,Ge),(mi||wt.receiveShadow!==k.receiveShadow)&&(wt.receiveShadow=k.receiveShadow,jt.setValue(D,"receiveShadow",k.receiveShadow)),(U.isMeshStandardMaterial||U.isMeshLambertMaterial||U.isMeshPhongMaterial)&&U.envMap===null&&P.environment!==null&&(Fe.envMapIntensity.value=P.environmentIntensity),Fe.dfgLUT!==void 0&&(Fe.dfgLUT.value=BM()),mi){if(jt.setValue(D,"toneMappingExposure",L.toneMappingExposure),wt.needsLights&&yg(Fe,zi),ft&&U.fog===!0&&at.refreshFogUniforms(Fe,ft),at.refreshMaterialUniforms(Fe,U,gt,Ct,A.state.transmissionRenderTarget[y.id]),wt.needsLights&&wt.numLightProbeGrids>0){let me=b,De=0;for(let Qn of A.state.lightProbeGridArray)Qn.texture!==null&&(me.textures[De]=Qn.texture,me.min[De]=Qn.boundingBox.min,me.max[De]=Qn.boundingBox.max,me.resolution[De]=Qn.resolution,De++);for(let Qn in me)me[Qn].length=De;Fe.probesSH.value=me.textures,Fe.probesMin.value=me.min,Fe.probesMax.value=me.max,Fe.probesResolution.value=me.resolution}Ns.upload(D,id(wt),Fe,kt)}if(U.isShaderMaterial&&U.uniformsNeedUpdate===!0&&(Ns.upload(D,id(wt),Fe,kt),U.uniformsNeedUpdate=!1),U.isSpriteMaterial&&jt.setValue(D,"center",k.center),jt.setValue(D,"modelViewMatrix",k.modelViewMatrix),jt.setValue(D,"normalMatrix",k.normalMatrix),jt.setValue(D,"modelMatrix",k.matrixWorld),U.uniformsGroups!==void 0){let me=U.uniformsGroups;for(let De=0,Qn=me.length;De<Qn;De++){let od=me[De];At.update(od,Ge),At.bind(od,Ge)}}return Ge}function yg(y,P){y.ambientLightColor.needsUpdate=P,y.lightProbe.needsUpdate=P,y.sunLights.needsUpdate=P,y.sunLightShadows.needsUpdate=P,y.directionalLights.needsUpdate=P,y.directionalLightShadows.needsUpdate=P,y.pointLights.needsUpdate=P,y.pointLightShadows.needsUpdate=P,y.spotLights.needsUpdate=P,y.spotLightShadows.needsUpdate=P,y.rectAreaLights.needsUpdate=P,y.hemisphereLights.needsUpdate=P}function Mg(y){return y.isMeshLambertMaterial||y.isMeshToonMaterial||y.isMeshPhongMaterial||y.isMeshStandardMaterial||y.isShadowMaterial||y.isShaderMaterial&&y.lights===!0}this.getActiveCubeFace=function(){return $},this.getActiveMipmapLevel=function(){return V},this.getRenderTarget=function(){return it},this.setRenderTargetTextures=function(y,P,G){let U=Lt.get(y);U.__autoAllocateDepthBuffer=y.resolveDepthBuffer===!1,U.__autoAllocateDepthBuffer===!1&&(U.__useRenderToTexture=!1),Lt.get(y.texture).__webglTexture=P,Lt.get(y.depthTexture).__webglTexture=U.__autoAllocateDepthBuffer?void 0:G,U.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(y,P){let G=Lt.get(y);G.__webglFramebuffer=P,G.__useDefaultFramebuffer=P===void 0},this.setRenderTarget=function(y,P=0,G=0){it=y,$=P,V=G;let U=null,k=!1,ft=!1;if(y){let ut=Lt.get(y);if(ut.__useDefaultFramebuffer!==void 0){mt.bindFramebuffer(D.FRAMEBUFFER,ut.__webglFramebuffer),et.copy(y.viewport),Mt.copy(y.scissor),It=y.scissorTest,mt.viewport(et),mt.scissor(Mt),mt.setScissorTest(It),W=-1;return}else if(ut.__webglFramebuffer===void 0)kt.setupRenderTarget(y);else if(ut.__hasExternalTextures)kt.rebindTextures(y,Lt.get(y.texture).__webglTexture,Lt.get(y.depthTexture).__webglTexture);else if(y.depthBuffer){let zt=y.depthTexture;if(ut.__boundDepthTexture!==zt){if(zt!==null&&Lt.has(zt)&&(y.width!==zt.image.width||y.height!==zt.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");kt.setupDepthRenderbuffer(y)}}let vt=y.texture;(vt.isData3DTexture||vt.isDataArrayTexture||vt.isCompressedArrayTexture)&&(ft=!0);let Et=Lt.get(y).__webglFramebuffer;y.isWebGLCubeRenderTarget?(Array.isArray(Et[P])?U=Et[P][G]:U=Et[P],k=!0):y.samples>0&&kt.useMultisampledRTT(y)===!1?U=Lt.get(y).__webglMultisampledFramebuffer:Array.isArray(Et)?U=Et[G]:U=Et,et.copy(y.viewport),Mt.copy(y.scissor),It=y.scissorTest}else et.copy(Pt).multiplyScalar(gt).floor(),Mt.copy(te).multiplyScalar(gt).floor(),It=re;if(G!==0&&(U=Y),mt.bindFramebuffer(D.FRAMEBUFFER,U)&&mt.drawBuffers(y,U),mt.viewport(et),mt.scissor(Mt),mt.setScissorTest(It),k){let ut=Lt.get(y.texture);D.framebufferTexture2D(D.FRAMEBUFFER,D.COLOR_ATTACHMENT0,D.TEXTURE_CUBE_MAP_POSITIVE_X+P,ut.__webglTexture,G)}else if(ft){let ut=P;for(let vt=0;vt<y.textures.length;vt++){let Et=Lt.get(y.textures[vt]);D.framebufferTextureLayer(D.FRAMEBUFFER,D.COLOR_ATTACHMENT0+vt,Et.__webglTexture,G,ut)}}else if(y!==null&&G!==0){let ut=Lt.get(y.texture);D.framebufferTexture2D(D.FRAMEBUFFER,D.COLOR_ATTACHMENT0,D.TEXTURE_2D,ut.__webglTexture,G)}W=-1};function rd(y){let P=Lt.get(y);return(P.__readFormat!==y.format||P.__readType!==y.type)&&(P.__readFormat=y.format,P.__readType=y.type,P.__formatReadable=fe.textureFormatReadable(y.format),P.__typeReadable=fe.textureTypeReadable(y.type)),P}this.readRenderTargetPixels=function(y,P,G,U,k,ft,bt,ut=0){if(!(y&&y.isWebGLRenderTarget)){Ot("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let vt=Lt.get(y).__webglFramebuffer;if(y.isWebGLCubeRenderTarget&&bt!==void 0&&(vt=vt[bt],Array.isArray(vt)&&(vt=vt[0])),vt){mt.bindFramebuffer(D.FRAMEBUFFER,vt);try{let Et=y.textures[ut],zt=Et.format,Zt=Et.type;y.textures.length>1&&D.readBuffer(D.COLOR_ATTACHMENT0+ut);let St=rd(Et);if(St.__formatReadable===!1){Ot("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(St.__typeReadable===!1){Ot("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}P>=0&&P<=y.width-U&&G>=0&&G<=y.height-k&&D.readPixels(P,G,U,k,ot.convert(zt),ot.convert(Zt),ft)}finally{let Et=it!==null?Lt.get(it).__webglFramebuffer:null;mt.bindFramebuffer(D.FRAMEBUFFER,Et)}}},this.readRenderTargetPixelsAsync=async function(y,P,G,U,k,ft,bt,ut=0){if(!(y&&y.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let vt=Lt.get(y).__webglFramebuffer;if(y.isWebGLCubeRenderTarget&&bt!==void 0&&(vt=vt[bt],Array.isArray(vt)&&(vt=vt[0])),vt)if(P>=0&&P<=y.width-U&&G>=0&&G<=y.height-k){mt.bindFramebuffer(D.FRAMEBUFFER,vt);let Et=y.textures[ut],zt=Et.format,Zt=Et.type;y.textures.length>1&&D.readBuffer(D.COLOR_ATTACHMENT0+ut);let St=rd(Et);if(St.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(St.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let Jt=D.createBuffer();D.bindBuffer(D.PIXEL_PACK_BUFFER,Jt),D.bufferData(D.PIXEL_PACK_BUFFER,ft.byteLength,D.STREAM_READ),D.readPixels(P,G,U,k,ot.convert(zt),ot.convert(Zt),0),D.bindBuffer(D.PIXEL_PACK_BUFFER,null);let Se=it!==null?Lt.get(it).__webglFramebuffer:null;mt.bindFramebuffer(D.FRAMEBUFFER,Se);let ce=D.fenceSync(D.SYNC_GPU_COMMANDS_COMPLETE,0);return D.flush(),await Lf(D,ce,4),D.bindBuffer(D.PIXEL_PACK_BUFFER,Jt),D.getBufferSubData(D.PIXEL_PACK_BUFFER,0,ft),D.bindBuffer(D.PIXEL_PACK_BUFFER,null),D.deleteBuffer(Jt),D.deleteSync(ce),ft}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(y,P=null,G=0){let U=Math.pow(2,-G),k=Math.floor(y.image.width*U),ft=Math.floor(y.image.height*U),bt=P!==null?P.x:0,ut=P!==null?P.y:0;kt.setTexture2D(y,0),D.copyTexSubImage2D(D.TEXTURE_2D,G,0,0,bt,ut,k,ft),mt.unbindTexture()},this.copyTextureToTexture=function(y,P,G=null,U=null,k=0,ft=0){let bt,ut,vt,Et,zt,Zt,St,Jt,Se,ce=y.isCompressedTexture?y.mipmaps[ft]:y.image;if(G!==null)bt=G.max.x-G.min.x,ut=G.max.y-G.min.y,vt=G.isBox3?G.max.z-G.min.z:1,Et=G.min.x,zt=G.min.y,Zt=G.isBox3?G.min.z:0;else{let jt=Math.pow(2,-k);bt=Math.floor(ce.width*jt),ut=Math.floor(ce.height*jt),y.isDataArrayTexture?vt=ce.depth:y.isData3DTexture?vt=Math.floor(ce.depth*jt):vt=1,Et=0,zt=0,Zt=0}U!==null?(St=U.x,Jt=U.y,Se=U.z):(St=0,Jt=0,Se=0);let le=ot.convert(P.format),ze=ot.convert(P.type),wt;P.isData3DTexture?(kt.setTexture3D(P,0),wt=D.TEXTURE_3D):P.isDataArrayTexture||P.isCompressedArrayTexture?(kt.setTexture2DArray(P,0),wt=D.TEXTURE_2D_ARRAY):(kt.setTexture2D(P,0),wt=D.TEXTURE_2D),mt.activeTexture(D.TEXTURE0),mt.pixelStorei(D.UNPACK_FLIP_Y_WEBGL,P.flipY),mt.pixelStorei(D.UNPACK_PREMULTIPLY_ALPHA_WEBGL,P.premultiplyAlpha),mt.pixelStorei(D.UNPACK_ALIGNMENT,P.unpackAlignment);let Xe=mt.getParameter(D.UNPACK_ROW_LENGTH),ne=mt.getParameter(D.UNPACK_IMAGE_HEIGHT),ki=mt.getParameter(D.UNPACK_SKIP_PIXELS),Ge=mt.getParameter(D.UNPACK_SKIP_ROWS),lo=mt.getParameter(D.UNPACK_SKIP_IMAGES);mt.pixelStorei(D.UNPACK_ROW_LENGTH,ce.width),mt.pixelStorei(D.UNPACK_IMAGE_HEIGHT,ce.height),mt.pixelStorei(D.UNPACK_SKIP_PIXELS,Et),mt.pixelStorei(D.UNPACK_SKIP_ROWS,zt),mt.pixelStorei(D.UNPACK_SKIP_IMAGES,Zt);let mi=y.isDataArrayTexture||y.isData3DTexture,zi=P.isDataArrayTexture||P.isData3DTexture;if(y.isDepthTexture){let jt=Lt.get(y),Fe=Lt.get(P),Tn=Lt.get(jt.__renderTarget),me=Lt.get(Fe.__renderTarget);mt.bindFramebuffer(D.READ_FRAMEBUFFER,Tn.__webglFramebuffer),mt.bindFramebuffer(D.DRAW_FRAMEBUFFER,me.__webglFramebuffer);for(let De=0;De<vt;De++)mi&&(D.framebufferTextureLayer(D.READ_FRAMEBUFFER,D.COLOR_ATTACHMENT0,Lt.get(y).__webglTexture,k,Zt+De),D.framebufferTextureLayer(D.DRAW_FRAMEBUFFER,D.COLOR_ATTACHMENT0,Lt.get(P).__webglTexture,ft,Se+De)),D.blitFramebuffer(Et,zt,Et+bt,zt+ut,St,Jt,St+bt,Jt+ut,D.DEPTH_BUFFER_BIT,D.NEAREST);mt.bindFramebuffer(D.READ_FRAMEBUFFER,null),mt.bindFramebuffer(D.DRAW_FRAMEBUFFER,null)}else if(k!==0||y.isRenderTargetTexture||Lt.has(y)){let jt=Lt.get(y),Fe=Lt.get(P);mt.bindFramebuffer(D.READ_FRAMEBUFFER,I),mt.bindFramebuffer(D.DRAW_FRAMEBUFFER,X);for(let Tn=0;Tn<vt;Tn++)mi?D.framebufferTextureLayer(D.READ_FRAMEBUFFER,D.COLOR_ATTACHMENT0,jt.__webglTexture,k,Zt+Tn):D.framebufferTexture2D(D.READ_FRAMEBUFFER,D.COLOR_ATTACHMENT0,D.TEXTURE_2D,jt.__webglTexture,k),zi?D.framebufferTextureLayer(D.DRAW_FRAMEBUFFER,D.COLOR_ATTACHMENT0,Fe.__webglTexture,ft,Se+Tn):D.framebufferTexture2D(D.DRAW_FRAMEBUFFER,D.COLOR_ATTACHMENT0,D.TEXTURE_2D,Fe.__webglTexture,ft),k!==0?D.blitFramebuffer(Et,zt,Et+bt,zt+ut,St,Jt,St+bt,Jt+ut,D.COLOR_BUFFER_BIT,D.NEAREST):zi?D.copyTexSubImage3D(wt,ft,St,Jt,Se+Tn,Et,zt,bt,ut):D.copyTexSubImage2D(wt,ft,St,Jt,Et,zt,bt,ut);mt.bindFramebuffer(D.READ_FRAMEBUFFER,null),mt.bindFramebuffer(D.DRAW_FRAMEBUFFER,null)}else zi?y.isDataTexture||y.isData3DTexture?D.texSubImage3D(wt,ft,St,Jt,Se,bt,ut,vt,le,ze,ce.data):P.isCompressedArrayTexture?D.compressedTexSubImage3D(wt,ft,St,Jt,Se,bt,ut,vt,le,ce.data):D.texSubImage3D(wt,ft,St,Jt,Se,bt,ut,vt,le,ze,ce):y.isDataTexture?D.texSubImage2D(D.TEXTURE_2D,ft,St,Jt,bt,ut,le,ze,ce.data):y.isCompressedTexture?D.compressedTexSubImage2D(D.TEXTURE_2D,ft,St,Jt,ce.width,ce.height,le,ce.data):D.texSubImage2D(D.TEXTURE_2D,ft,St,Jt,bt,ut,le,ze,ce);mt.pixelStorei(D.UNPACK_ROW_LENGTH,Xe),mt.pixelStorei(D.UNPACK_IMAGE_HEIGHT,ne),mt.pixelStorei(D.UNPACK_SKIP_PIXELS,ki),mt.pixelStorei(D.UNPACK_SKIP_ROWS,Ge),mt.pixelStorei(D.UNPACK_SKIP_IMAGES,lo),ft===0&&P.generateMipmaps===!0&&P.mipmapsAutoUpdate===!0&&D.generateMipmap(wt),mt.unbindTexture()},this.initRenderTarget=function(y){Lt.get(y).__webglFramebuffer===void 0&&kt.setupRenderTarget(y)},this.initTexture=function(y){y.isCubeTexture?kt.setTextureCube(y,0):y.isData3DTexture?kt.setTexture3D(y,0):y.isDataArrayTexture||y.isCompressedArrayTexture?kt.setTexture2DArray(y,0):kt.setTexture2D(y,0),mt.unbindTexture()},this.resetState=function(){$=0,V=0,it=null,mt.reset(),lt.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return Sn}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;let e=this.getContext();e.drawingBufferColorSpace=Kt._getDrawingBufferColorSpace(t),e.unpackColorSpace=Kt._getUnpackColorSpace()}};var H=i=>new O(...i);function $t(i,t,e,n=0){let s=H(t).normalize(),r=H(e).addScaledVector(s,-s.dot(H(e))).normalize(),o=s.clone().cross(r);return new Qt().makeBasis(r,o,s).multiply(new Qt().makeRotationZ(n)).setPosition(H(i))}var Us=({place:i,direction:t,bands:e})=>[e[0][0],e.at(-1)[1]].map(n=>H(i).addScaledVector(H(t),n));function Nn(i){let t=H(i),e=Math.abs(t.x)<.9?new O(1,0,0):new O(0,1,0);return e.addScaledVector(t,-t.dot(e)).normalize()}function bp(i,t,e,n){let[s,r,o,a]=[i,t,e,n].map(H),l=o.clone().sub(s),c=r.dot(a),h=1-c*c,u=h<1e-9?l.dot(r):(l.dot(r)-c*l.dot(a))/h;return s.addScaledVector(r,u)}var Me=(i,t)=>H(t).sub(H(i.point)).dot(H(i.direction)),be=(i,t)=>H(i.point).addScaledVector(H(i.direction),t),Zn=(i,t)=>be(i,Me(i,t)).distanceTo(H(t)),he=(i,t)=>Math.abs(H(i).dot(H(t)))>1-1e-6;function ol(i,t,e,n){let[s,r]=[i.bodies[t],i.bodies[e]];return he(s.direction,r.direction)&&Zn(s,r.point)<1e-6*n}var Sp=16,kM=.6,zM=1.3,GM=.14,qh=[.8,12],wp=()=>new O;function Qi(i,t=wp){let e=i.dials.map(({body:s,centre:r,normal:o,radius:a})=>({at:H(r).add(t(s)),direction:o,radius:1.08*a,body:s,faces:o}));return[...i.wheels.flatMap(s=>VM(Jn(s),s,t(s.body)).flatMap(r=>Tp(i,s,r,t))),...e]}var al=(i,t)=>Tp(i,t,{at:H(t.centre),direction:t.direction,radius:Jn(t),body:t.body},wp),Vr=({root:i,radius:t,module:e})=>Math.max(i,t)+2*Math.max(e,.02*t),Jn=i=>i.kind==="ring"?Vr(i):Math.max(i.tip,i.radius);function VM(i,{body:t,centre:e,direction:n,thickness:s,cone:r},o){let a=r?1.1*s:.6*s;return[a,-a].map(l=>({at:H(e).add(o).addScaledVector(H(n),l),direction:n,radius:i,body:t}))}function Tp(i,t,e,n){let s=i.bodies[t.body].parent??0,r={...i.bodies[s],point:H(i.bodies[s].point).add(n(s))};if(r.parent===null)return[e];let o=be(r,Me(r,e.at)),a=H(e.direction).dot(H(r.direction)),[l,c]=[Math.abs(a)*e.radius,Math.sqrt(Math.max(0,1-a*a))*e.radius],h=o.distanceTo(e.at)+l;return[c,-c].map(u=>({at:o.clone().addScaledVector(H(r.direction),u),direction:r.direction,radius:h,body:t.body}))}function On({at:i,direction:t,radius:e}){let n=Nn(t),s=H(t).cross(n);return Array.from({length:Sp},(r,o)=>{let a=2*Math.PI*o/Sp;return i.clone().addScaledVector(n,e*Math.cos(a)).addScaledVector(s,e*Math.sin(a))})}function ll(i,t,e=[]){let n=new In().setFromPoints([...t.flatMap(On),...e]);if(n.isEmpty())for(let{point:s}of i.bodies)n.expandByPoint(H(s).addScalar(10)).expandByPoint(H(s).subScalar(10));return n.getBoundingSphere(new dn)}function cl(i,t,e){let n=({faces:r})=>!(e&&r&&H(r).dot(e)<0),s=(r,o)=>t.skewed[o]?r:t.apart(r,t.height(r));return Qi(i,r=>t.shift(r)).filter(n).flatMap(r=>On(r).map(o=>s(o,r.body)))}function hl(i,t,e){if(!t.length)return qh[0];let{radius:n}=new In().setFromPoints(t).getBoundingSphere(new dn),s=t.map(h=>h.dot(e)),r=Math.max(...s)-Math.min(...s)||1e-9,o=Math.sqrt(Math.max(4*n*n-r*r,r*r)),a=i.wheels.filter(({direction:h})=>he(h,e.toArray())).map(({centre:h,thickness:u})=>[H(h).dot(e),u]);a.sort(([h],[u])=>h-u);let l=a.filter(([h,u],d)=>d===0||h-a[d-1][0]>.5*u).length,c=Math.max(kM,Math.min(zM,GM*(l+2)))*o;return Math.max(qh[0],Math.min(qh[1],c/r-1))}function ul(i){let t=i.parts.find(({kind:r})=>r==="frame"),e=new Map;for(let{direction:r,radius:o}of i.wheels){let a=r.map(l=>Math.abs(l).toFixed(4)).join(" ");e.set(a,{direction:r,size:(e.get(a)?.size??0)+o})}let n=[...e.values()].sort((r,o)=>o.size-r.size)[0],s=H(t?.direction??n?.direction??[0,0,1]);return s.dot(new O(0,0,1))<0?s.negate():s}var Oi=["#0072b2","#a05a00","#bb2288","#227755","#440088","#772200","#0000ee","#dd2266","#005544","#442244"],dl="#b3261e",Ep="#655f52",Hr="#c9c3b4";var nn=Oi,fl=dl,$h=Oi[0],Yh=Oi[6],Kn=["#cfa652","#d9b56b","#c49848","#d2ac62","#c9a047","#dcbb78"],Tt={arbor:"#9aa1ab",arm:"#b07f52",plate:"#a98a55",case:"#755d38",pipe:"#b98f4e",pin:"#5b636f",slot:"#828a96",face:"#ece5d3",silver:"#dfe2e6",bezel:"#b08d4c",mark:"#2b261d"},pl=(i,t,e)=>`#${[1,3,5].map(n=>{let[s,r]=[i,t].map(o=>parseInt(o.slice(n,n+2),16));return Math.round(s+e*(r-s)).toString(16).padStart(2,"0")}).join("")}`,ml=pl(Hr,Ep,.5),Ap=pl(dl,Hr,.35),Wr={surviving:Oi[3],reconstructed:Oi[1],hypothetical:Oi[2],"":ml};function Xr(i,t){if(!i)return ml;let e=1+Math.log10(Math.abs(i)/t)/6;return pl(Hr,Oi[i>0?0:1],Math.min(1,Math.max(.15,e)))}var gl=(i,t)=>i===null?ml:pl(Hr,dl,t?i/t:0);function Cp({bodies:i}){let t=i.map(n=>n.speed===null?0:n.sense*WM(n.speed)),e=Math.max(...t.map(Math.abs),1e-300);return t.map(n=>Xr(n,e))}var HM=[Tt.arm,Tt.plate,Tt.case,Tt.pipe,Tt.bezel];function Rp(i,t){let e=t==="speed"?Cp(i):null;return({colour:n,body:s})=>t==="plain"||!HM.includes(n)?n:e?.[s]??ml}function Pp(i,t){let e=Cp(i),n=Math.max(...i.wheels.map(r=>r.loss??0),0),s={speed:r=>e[r.body],status:r=>Wr[r.status]??Wr[""],loss:r=>gl(r.loss,n)};return i.wheels.map(s[t]??(r=>Kn[r.body%Kn.length]))}function WM(i){let[t,e="1"]=i.split("/");return Number(t)/Number(e)}var Ip=.26,XM=.1,qM=.05,$M=.75,Fs=class{constructor(t,e,n,s,r){Object.assign(this,{scene:t,palette:e,wheels:n,parts:s,sight:r}),this.chosen=null,this.selected=null,this.toothed=!1,this.front=null,this.broken=this.wheelsOf({pairs:t.pairs.flatMap(({broken:o},a)=>o?[a]:[])})}paint(t,e){this.mode=t,this.base=e?.wheels??Pp(this.scene,t),this.part=Rp(this.scene,t),this.recolour()}highlight(t,e){this.chosen=t&&{wheels:this.wheelsOf(t),bodies:t.bodies??[],colour:e??Yh},this.recolour()}select(t){this.selected=t,this.recolour()}wheelsOf({wheels:t=[],bodies:e=[],pairs:n=[]}){let s=o=>typeof o=="number"?this.scene.pairs[o]:this.scene.pairs.find(({id:a})=>a===o),r=new Set([...t,...n.flatMap(o=>s(o)?.wheels??[])]);return this.scene.wheels.forEach(({body:o},a)=>e.includes(o)&&r.add(a)),r}recolour(){let{chosen:t}=this;this.wheels.forEach((s,r)=>{let[o,a,l]=[t?.wheels.has(r),this.broken.has(r),r===this.selected],c=new Bt(a?fl:this.base[r]);o&&c.lerp(new Bt(t.colour),.8),l&&c.set(Yh);let h=this.mode!=="plain"||a||o||l;s.paint({colour:c,gloss:h?.35:$M,opacity:t&&!o&&!l?Ip:1})});let e=new Set([...[...t?.wheels??[]].map(s=>this.scene.wheels[s].body),...t?.bodies??[]]),n=({body:s,plate:r})=>!t||e.has(s)&&!r;for(let s of this.parts){let r=n(s)?this.isGlass(s)?XM:1:Ip;this.palette.paint(s.slot,{opacity:r,...s.colour&&this.part&&{colour:new Bt(this.part(s))}})}}glaze(t,e){if(this.eye?.equals(t))return;this.eye=t.clone();let n=t.clone().sub(e),s=({cover:o,at:a,pane:l})=>l?this.sight.hidden(l,t)>qM:n.dot(o)*a.clone().sub(e).dot(o)>0,r=this.parts.filter(o=>o.cover&&s(o)||o.bar&&this.sight.isCovering(o.bar,t));this.glass?.length===r.length&&r.every((o,a)=>o===this.glass[a])||(this.glass=r,this.recolour())}isGlass(t){return!!this.glass?.includes(t)}hideBefore(t){this.front=t;let e=this.scene.wheels.map(({centre:a})=>t?H(a).dot(t):0),[n,s]=[Math.min(...e),Math.max(...e)],r=({at:a})=>t!==null&&a!==null&&a.dot(t)>(n+s)/2+1e-9,o=s-n<1e-6;this.wheels.forEach(a=>a.show(o||!r(a),this.toothed));for(let a of this.parts)(a.dial!==void 0||a.cover)&&this.palette.paint(a.slot,{shown:!r(a)})}showTeeth(t){this.toothed=t,this.hideBefore(this.front)}};var YM=2*Math.PI,Gt=class{constructor(){Object.assign(this,{points:[],normals:[],grains:[],indices:[]})}get corners(){return this.points.length/3}corner(t,e,n){this.points.push(t[0],t[1],t[2]),this.normals.push(e[0],e[1],e[2]),this.grains.push(n[0],n[1],n[2])}face(t,e,n){let s=this.corners;t.forEach((r,o)=>this.corner(r,e,Array.isArray(n[0])?n[o]:n));for(let r=2;r<t.length;r+=1)this.indices.push(s,s+r-1,s+r);return this}};function ee(i,t,e,n=0,s=1){let{points:r,normals:o,grains:a,indices:l}=i;return t.reduce((h,[u,d],f)=>h+u*t[(f+1)%t.length][1]-t[(f+1)%t.length][0]*d,0)<0&&(t=t.toReversed()),t.forEach(([h,u],d)=>{let[f,m]=t[(d+1)%t.length],x=Math.hypot(f-h,m-u);if(!x||h<1e-12&&f<1e-12)return;let[p,g]=[(m-u)/x,(h-f)/x],S=i.corners;for(let w=0;w<=e;w+=1){let b=YM*(n+s*w/e),[C,A]=[Math.cos(b),Math.sin(b)];r.push(h*C,h*A,u,f*C,f*A,m),o.push(p*C,p*A,g,p*C,p*A,g),a.push(-A,C,0,-A,C,0)}for(let w=S;w<S+2*e;w+=2)h>=1e-12&&l.push(w,w+1,w+2),f>=1e-12&&l.push(w+1,w+3,w+2)}),i}function ye(i,t,e,n){let s=Math.min(.12*(n-e),.25*(t-i));return[[i,e],[t-s,e],[t,e+s],[t,n-s],[t-s,n],[i,n]]}var Un=(i,t,e,n=14)=>ee(new Gt,ye(0,i,t,e),n),_l=(i,t=16)=>ee(new Gt,Lp(i,t/2),t),Zh=(i,t,e=24)=>ee(new Gt,Lp(i,e),e,t,.5),Lp=(i,t)=>Array.from({length:t+1},(e,n)=>{let s=Math.PI*(n/t-.5);return[i*Math.max(0,Math.cos(s)),i*Math.sin(s)]});function wn(i,t,e,n,s=r=>r){let r=l=>s(l).map((c,h)=>c-s([0,0,0])[h]),o=r([1,0,0]),a=(l,c,h)=>s([l,c,h]);for(let l=1;l<t.length;l+=1){let[[c,h],[u,d]]=[t[l-1],t[l]];for(let[f,m]of[[e,-1],[n,1]])i.face([a(c,-h,f),a(u,-d,f),a(u,d,f),a(c,h,f)],r([0,0,m]),o);for(let f of[-1,1]){let m=Math.hypot(u-c,d-h),x=r([(h-d)/m,f*(u-c)/m,0]);i.face([a(c,f*h,e),a(u,f*d,e),a(u,f*d,n),a(c,f*h,n)],x,o)}}for(let[[l,c],h]of[[t[0],-1],[t.at(-1),1]])c>1e-9&&i.face([a(l,-c,e),a(l,c,e),a(l,c,n),a(l,-c,n)],r([h,0,0]),o);return i}function xl(i,t,e,n){let s=(o,a,l)=>[0,22,45,65,82].map(c=>{let h=c*Math.PI/180;return[l-a*o*Math.cos(h),o*Math.sin(h)]}),r=[[0,t],[.3*t,t],[1.6*t,n],[i-1.6*e,n],[i-.3*e,e],[i,e]];return[...s(t,1,0),...r.filter(([o],a)=>a<2||a>3||o>.9*t&&o<i-.9*e),...s(e,-1,i).reverse()]}var ZM=1.45,JM=[0,0,1],KM=[0,0,0];function Np(i,t){let e=i.dials[t];if(e.look==="ball")return[tb(i,t)];let n=i.pointers.flatMap(d=>d.dial===t?[d.level]:[]),s=Math.min(.012*e.radius,e.seated?.25*Math.min(...n):1/0),r=H(e.centre).addScaledVector(H(e.normal),e.plate?.5*s:0).toArray(),o=$t(r,e.normal,e.zero),a=jM(e),l=e.placed?1.005:1.03,c=ee(new Gt,ye(a,e.radius*l,-s,0),72),h=ee(new Gt,e.placed?[]:ye(e.radius*l,e.radius*1.075,-s,1.2*s),72),u={body:e.body,matrix:o,at:H(e.centre),dial:t,plate:!0};return[{...u,colour:Tt.face,gloss:.05,shape:c},{...u,colour:Tt.bezel,gloss:.8,shape:h},{...u,colour:Tt.mark,gloss:0,shape:QM(e)}]}function jM({radius:i,scale:t}){let e=t.turns>1?t.outer-t.inner+(t.outer-t.inner)/t.turns+.02:.26;return Math.max(.05,t.outer-e)*i}function Kh(i){let[t,e]=[0,0];return Array.from({length:i.length/2},(n,s)=>[(t+=i[2*s])/4e3,(e+=i[2*s+1])/4e3])}function QM({radius:i,engraving:t}){let e=new Gt;for(let[n,s,r]of t){let o=n==="letters"?s:ZM*s;for(let a of r){let l=Kh(a).map(([c,h])=>[i*h,-i*c]);for(let c=1;c<l.length;c+=1)Op(e,l[c-1],l[c],o*i,.004*i)}}return e}function Op(i,[t,e],[n,s],r,o){let a=Math.hypot(n-t,s-e)||1,[l,c]=[(n-t)*r/2/a,(s-e)*r/2/a],[h,u]=[.7*l,.7*c];i.face([[t-h+c,e-u-l,o],[n+h+c,s+u-l,o],[n+h-c,s+u+l,o],[t-h-c,e-u+l,o]],JM,KM)}function tb(i,t){let{body:e,centre:n,normal:s,radius:r}=i.dials[t],o=ee(new Gt,ye(1.06*r,1.25*r,-.2*r,.2*r),40),a=$t(n,[0,0,i.front],s);return{body:e,colour:Tt.bezel,gloss:.8,shape:o,matrix:a,at:H(n),dial:t}}function Up(i,t,e){let{dial:n}=i.pointers[t],{look:s,centre:r,normal:o,radius:a}=i.dials[n];if(s!=="ball")return rb(i,t,e);let c={gloss:.3,matrix:$t(r,o,[0,0,i.front]),at:H(r),dial:n};return[{...c,colour:Tt.mark,shape:Zh(a,-.25)},{...c,colour:Tt.silver,shape:Zh(a,.25)}]}var eb=.07;function qr({pointers:i,dials:t},e){let n=i[e],s=({dial:o})=>t[o].radius,r=({body:o,dial:a,seat:l})=>l&&n.seat&&o===n.body&&a!==null&&String(t[a].normal)===String(t[n.dial].normal);return i.reduce((o,a,l)=>r(a)&&s(a)>s(i[o])?l:o,e)}function Bs(i,t){let{pointers:e}=i;if(e[t].dial===null)return 0;let n=qr(i,t);return e.slice(0,n).filter(({dial:s})=>s===e[n].dial).length}function jh({outline:i,reach:t,ball:e},n,s){let r=n*t*(e?1:1-eb*(s%4));return i.map(([o,a])=>[r*o,r*a])}var Jh=23.44*Math.PI/180,nb=.62,Dp=.05;function ib(i){let t=Math.asin(Math.sin(Jh)*Math.sin(i)),e=Math.atan2(Math.cos(Jh)*Math.sin(i),Math.cos(i)),n=Math.tan((Math.PI/2+t)/2)/Math.tan((Math.PI/2+Jh)/2);return[n*Math.cos(e),n*Math.sin(e)]}function sb({hand:i,ball:t,reach:e},n,s,[r,o]){let a=n.scale.outer*n.radius;if(i==="ecliptic"){let d=Array.from({length:120},(g,S)=>ib(Math.PI*S/60).map(w=>nb*a*w)),f=(d[30][1]+d[90][1])/2,m=d[30][1]-f,x=ee(new Gt,ye(m-Dp*a,m,r,o),96);for(let g=0;g<x.corners;g+=1)x.points[3*g+1]+=f;let p=new Gt;for(let g=0;g<120;g+=10){let[S,w]=d[g],b=1-Dp*a/m;Op(p,[S,w],[b*S,f+b*(w-f)],.008*a,o+.002*a)}return[{...s,colour:Tt.bezel,shape:x},{...s,colour:Tt.mark,gloss:0,shape:p}]}if(!t)return[];let[l,c]=[e*a-t*n.radius,t*n.radius],h=_l(c,20);for(let d=0;d<h.corners;d+=1)h.points[3*d]+=l,h.points[3*d+2]+=o+.6*c;let u=i==="bead"?ee(new Gt,ye(l-.3*c,l+.3*c,r,o),72):new Gt;return[{...s,shape:h},{...s,colour:Tt.bezel,shape:u}]}function rb(i,t,e){let n=i.pointers[t],s=i.dials[n.dial],{radius:r,scale:o}=s,a=Math.min(.012*r,n.seat?.9:1/0),[l,c]=[n.level-a/2,n.level+a/2],h=H(s.centre),u={colour:nn[e%nn.length],gloss:.35,matrix:$t(h.toArray(),s.normal,s.zero),at:h,dial:n.dial},d=b=>ee(b,ye(0,Math.max(.05*r,Math.min(.75*n.seat,Math.max(.55*n.seat,.35*r))),l,c+.004*r),20);if(o.turns===1)return[{...u,shape:d(wn(new Gt,jh(n,o.outer*r,e),l,c))},...sb(n,s,u,[l,c])];let[f,m]=[o.inner*r,(o.outer-o.inner)*r],x=[[-.2,.02],[-.16,.035],[-.1,.03],[0,.026],[o.inner-.14,.026],[o.inner-.12,.034],[o.inner-.06,.034],[o.inner-.05,.026]],p=d(wn(new Gt,x.map(b=>b.map(C=>C*r)),l,c)),g=[[f-m-.1*r,.012],[f-.03*r,.012],[f-.02*r,.02],[f+.01*r,.02],[f+.03*r,.004]],S=wn(new Gt,g.map(([b,C])=>[b,C*r]),c,c+a),w=S.corners;ee(S,ye(0,.014*r,.002*r,c+1.8*a),12);for(let b=w;b<S.corners;b+=1)S.points[3*b]+=f;return[{...u,shape:p},{...u,colour:Tt.mark,gloss:.5,shape:S,slides:t}]}var Ui=(i,t)=>(i%t+t)%t,sn=class{constructor(t,e,n){this.machine=e,this.index=n,this.pointer=t.pointers[n],this.order=Bs(t,n),this.dial=this.pointer.dial===null?null:t.dials[this.pointer.dial],this.scale=this.dial?.scale??{turns:1,divisions:0,way:1,names:[]},this.turns=this.scale.turns,this.sense=this.pointer.sense*this.scale.way,this.start=this.sense*(t.bodies[this.pointer.body].start-t.bodies[this.pointer.base].start)/(2*Math.PI),this.travels=t.bodies[this.pointer.body].travels,this.known=this.pointer.speed!==null&&!!e}get now(){if(!this.known)return null;if(this.travels){let{whole:n,angle:s}=this.machine.pointer(this.index);return{travel:Number(n)+s/(2*Math.PI),scale:this.scale,cell:null}}let t=Ui(this.sense*this.machine.pointer(this.index).along,this.turns),{divisions:e}=this.scale;return{turns:t,degrees:Ui(t,1)*360,scale:this.scale,cell:e>1?t/this.turns*e:null}}};function ks(i,t=2){let e=i.toFixed(t);return`${Number(e)===360?0 .toFixed(t):e}°`}var ob=({cell:i,scale:t})=>Math.floor(i+1e-9)%t.divisions;function ab(i){let{scale:t,turns:e}=i,n=ob(i),s=t.names.find(([o,a,l])=>o&&n+1e-9>=vl(a)&&n+1e-9<vl(a)+vl(l)),r=t.turns>1?[`turn ${Math.floor(e+1e-9)%t.turns+1}`]:[];return s&&r.push(s[0]),t.cells?.length?r.push(t.cells[n]):s?t.names.length<t.divisions&&r.push(`${t.cell} ${n-Math.floor(vl(s[1]))+1}`):r.push(`${t.cell} ${lb(t,n)}`),r.push(...t.glyphs.filter(([o,a])=>a&&o===n+1).map(([,o])=>o)),r.join(", ")}var lb=({counted:i,radial:t},e)=>i?t?Ui(e-1,i)+1:e%i:e+1,vl=i=>{let[t,e=1]=i.split("/");return t/e};function zs(i){return i?i.travel!==void 0?`${i.travel.toFixed(2)} mm`:i.cell===null?ks(i.degrees):`${ks(i.degrees)}, ${ab(i)}`:"not determined"}var cb=.035,hb=.7,ub=({bodies:i,dials:t,pointers:e})=>t.flatMap(({look:n,centre:s},r)=>{let o=e.find(({dial:a})=>a===r)?.body;return n==="ball"&&o!==void 0?[{...i[o],point:s,as:o,ball:r}]:[]}),db=({bodies:i,dials:t,pointers:e})=>e.flatMap(({body:n,dial:s},r)=>s!==null&&t[s].scale.turns>1?[{...i[n],as:n,slide:r}]:[]);function fb(i,{kind:t,point:e,direction:n,down:s,length:r,rate:o},a){let l=$t(e,n,s),c=r+Math.max(.1*r-r,o*a),h=new Qt;t==="pendulum"?h.makeRotationZ(cb*Math.sin(o*a)):t==="line"?h.makeScale(c/r,1,1):h.makeTranslation(c-r,0,0),i.copy(l).multiply(h).multiply(l.invert())}var Gs=class{constructor(t,e,n,s){Object.assign(this,{machine:t,main:e,middle:n,parting:s,share:0});let{scene:r}=t,o=r.bodies.findIndex(a=>a.parent===null);this.bodies=[...r.bodies,...ub(r),...db(r),...r.hangers.map((a,l)=>({...a,parent:o,as:a.body,hangs:l}))],this.readings=this.bodies.map(({slide:a})=>a===void 0?null:new sn(t.scene,t,a)),this.root=new Gn,this.nodes=this.bodies.map(()=>new Gn),this.nodes.forEach(a=>a.matrixAutoUpdate=!1),this.bodies.forEach(({parent:a},l)=>(a===null?this.root:this.nodes[a]).add(this.nodes[l])),this.shifts=this.bodies.map(()=>new O),this.skewed=this.bodies.map((a,l)=>this.isSkew(l))}isSkew(t){let{parent:e,direction:n}=this.bodies[t];return e!==null&&(!he(n,this.main.toArray())||this.isSkew(e))}turn(t){this.bodies.forEach((e,n)=>{if(e.parent===null)return;let s=this.machine.moves?this.machine.joint(e.as??n):0,{matrix:r}=this.nodes[n];if(e.to!==void 0&&e.to!==null)return;if(e.hangs!==void 0)return fb(r,e,this.unwound(e.as,s));let o=H(e.point);if(e.travels)return r.makeTranslation(H(e.direction).multiplyScalar(s/(2*Math.PI)).add(this.shifts[n]));r.makeRotationAxis(H(e.direction),s);let a=this.slid(n);r.setPosition(o.clone().sub(a).applyMatrix4(r).negate().add(o).add(this.shifts[n]))}),this.root.updateMatrixWorld(!0),this.bodies.forEach((e,n)=>typeof e.to=="number"&&this.#t(e,this.nodes[n].matrixWorld)),this.nodes.forEach((e,n)=>t.set(e.matrixWorld.elements,16*n))}#t({body:t,to:e,point:n,direction:s,down:r,length:o},a){let l=H(n).applyMatrix4(this.nodes[t].matrixWorld),h=H(n).addScaledVector(H(r),o).applyMatrix4(this.nodes[e].matrixWorld).sub(l),u=H(s).transformDirection(this.nodes[t].matrixWorld);a.copy($t(l.toArray(),u.toArray(),h.toArray())).scale(H([h.length()/o,1,1])).multiply($t(n,s,r).invert())}unwound(t,e){let{machine:n}=this;if(!n.moves||n.simulated)return e;let s=2*Math.PI*n.scene.bodies[t].sense*n.speeds[t]*n.made();return e+2*Math.PI*Math.round((s-e)/(2*Math.PI))}explode(t){this.share=t,this.bodies.forEach(({parent:e},n)=>{if(this.shifts[n].set(0,0,0),!this.skewed[n]||this.skewed[e])return;let s=this.faced(n),r=s?H(s.centre):this.anchor(n),o=r.clone().sub(this.middle),a=s?0:hb;this.shifts[n].addScaledVector(o,t*a).addScaledVector(this.main,t*(this.height(r)-a*o.dot(this.main)))})}faced(t){let{pointers:e,dials:n}=this.machine.scene,{ball:s}=this.bodies[t];if(s!==void 0)return n[s];let r=e.find(({body:o,dial:a})=>o===t&&a!==null);return r&&!this.skewed[n[r.dial].body]?n[r.dial]:null}shift(t){let{parent:e}=this.bodies[t],n=this.shifts[t].clone();return e===null?n:n.add(this.shift(e))}slid(t){let e=this.readings[t];if(!e)return new O;let{zero:n,radius:s,scale:r}=e.dial;return H(n).multiplyScalar(s*(r.outer-r.inner)*(e.now?.turns??0)/r.turns)}slide(t){return this.bodies.findIndex(e=>e.slide===t)}ball(t){return this.bodies.findIndex(e=>e.ball===t)}hanger(t){return this.bodies.findIndex(e=>e.hangs===t)}anchor(t){let e=this.machine.scene.wheels.filter(({body:s})=>s===t).map(({centre:s})=>H(s)),n=e.reduce((s,r)=>s.add(r),new O);return e.length?n.divideScalar(e.length):H(this.bodies[t].point)}height(t){return this.parting*(t.dot(this.main)-this.middle.dot(this.main))}lift(t,e){return this.skewed[t]?0:e?this.height(e):n=>this.height(n)}apart(t,e){return t.clone().addScaledVector(this.main,this.share*e)}};var pb="http://www.w3.org/2000/svg";function Fp(i,t,e){for(let[n,s]of Object.entries(t??{}))s==null||s===!1||(n.startsWith("on")?i.addEventListener(n.slice(2),s):i.setAttribute(n,s===!0?"":String(s)));return i.append(...e.flat(1/0).filter(n=>n!=null&&n!==!1&&n!=="")),i}function M(i,t,...e){return Fp(document.createElement(i),t,e)}function Vt(i,t,...e){return Fp(document.createElementNS(pb,i),t,e)}function yl(i,t=i){let e=null;try{e=new URL(i)}catch{return M("span",{},t)}return["http:","https:"].includes(e.protocol)?M("a",{href:e.href,target:"_blank",rel:"noopener noreferrer"},t):M("span",{},t)}function mn(i){return Vt("svg",{viewBox:"0 0 24 24",class:"icon","aria-hidden":"true",focusable:"false"},Vt("path",{d:i}))}function ke(i,t,e={}){return M("label",{class:"field",...e},M("span",{},i),t)}function Qh(i,t,e){return M("details",{class:"more",ontoggle:e},M("summary",{},i),t)}var mb=0,tu=i=>`${i}-${mb+=1}`;var Bp=48,gb=.75,kp=[.42,.38,.82],_b={front:[0,0,1],back:[0,0,-1],side:[1,0,0],free:kp},xb=.045,vb={slot:()=>0,paint:()=>{}},Ml=class{constructor(t){Object.assign(this,{onPick:()=>{},onCrank:()=>{},onOrbit:()=>{}}),this.#t(t),this.paint("plain"),this.look("free")}rebuild(t){let{share:e}=this.poses;this.#t(t),this.paint("plain"),this.explode(e)}#t(t){let{scene:e}=t;Object.assign(this,{machine:t,scene:e}),this.main=ul(e);let n=Qi(e),s=hl(e,n.flatMap(On),this.main);this.poses=new Gs(t,this.main,ll(e,n).center,s);let r=e.wheels.filter(({direction:o})=>he(o,this.main.toArray()));this.flat=r.length>gb*e.wheels.length,this.canvas??=Vt("svg",{class:"plan"}),this.canvas.replaceChildren(),this.wheels=e.wheels.map((o,a)=>new eu(this,o,a)),this.hands=e.pointers.filter(({dial:o})=>o!==null).map(o=>new iu(this,o)),this.faces=e.dials.map(o=>new nu(this,o)),this.looks=new Fs(e,vb,this.wheels,[])}setTurns(t){this.machine.turns=nt.of(t),this.request()}paint(t,e){this.looks.paint(t,e)}highlight(t,e){this.looks.highlight(t,e)}select(t){this.looks.select(t)}explode(t){this.poses.explode(t),this.fit()}hideFront(t){this.looks.hideBefore(t?this.main.clone().multiplyScalar(this.scene.front*Math.sign(this.main.z||1)):null);for(let{node:e}of[...this.faces,...this.hands])e.style.display=t?"none":""}look(t){let[e,n,s]=_b[t==="free"&&this.flat?"front":t]??kp,r=this.scene.front||1;this.towards=H([e*r,n,s*r]).normalize(),this.right=H([0,1,0]).cross(this.towards).normalize(),this.up=this.towards.clone().cross(this.right),this.fit()}fit(){let t=cl(this.scene,this.poses).map(l=>this.seen(l)),e=l=>[Math.min(...t.map(c=>c[l])),Math.max(...t.map(c=>c[l]))],[[n,s],[r,o]]=[e(0),e(1)];this.width=Math.max(s-n,o-r,1e-6);let a=.04*this.width;this.canvas.setAttribute("viewBox",[n-a,r-a,s-n+2*a,o-r+2*a].join(" ")),this.render()}seen(t){return[t.dot(this.right),-t.dot(this.up)]}path(t,e,n){let s=this.poses.share*this.poses.lift(t,e),{matrixWorld:r}=this.poses.nodes[t],o=a=>this.seen(a.clone().addScaledVector(this.main,s).applyMatrix4(r));return`M${n.map(a=>o(a).map(l=>l.toFixed(3)).join(" ")).join("L")}`}request(){this.waiting||=requestAnimationFrame(()=>this.render())}render(){cancelAnimationFrame(this.waiting),this.waiting=0,this.poses.turn(new Float32Array(16*this.poses.nodes.length));let t=[...this.faces,...this.wheels,...this.hands];for(let n of t)n.draw();let e=t.sort((n,s)=>n.depth-s.depth).map(({node:n})=>n);e.some((n,s)=>n!==this.canvas.children[s])&&this.canvas.replaceChildren(...e)}depth(t,e){return e.clone().applyMatrix4(this.poses.nodes[t].matrixWorld).dot(this.towards)}cut(){}showTeeth(){}theme(){}resize(){}dispose(){cancelAnimationFrame(this.waiting)}},eu=class{constructor(t,e,n){let{id:s,teeth:r,kind:o,body:a,centre:l,direction:c,reference:h,turn:u}=e;Object.assign(this,{plan:t,wheel:e,body:a,at:H(l),ring:o==="ring"}),this.frame=$t(l,c,h,u),this.disc=Vt("path",{class:"disc"}),this.spoke=Vt("path",{class:"spoke"}),this.name=Vt("text",{},s);let d=Vt("title",{},`${s}, ${r} teeth`);this.node=Vt("g",{class:"wheel","data-wheel":s,onclick:()=>t.onPick(n)},d,this.disc,this.spoke,this.name)}paint({colour:t,opacity:e}){this.disc.setAttribute("fill",`#${t.getHexString()}`),this.disc.setAttribute("stroke",`#${t.clone().multiplyScalar(.35).getHexString()}`),this.node.setAttribute("opacity",e)}show(t){this.node.style.display=t?"":"none"}draw(){let{plan:t,body:e,wheel:n,frame:s,ring:r}=this,o=c=>t.path(e,this.at,c),[a,l]=r?[n.radius,Vr(n)]:[0,n.radius];this.disc.setAttribute("d",`${o(su(s,l))}Z${r?`${o(su(s,a))}Z`:""}`),this.spoke.setAttribute("d",o([a,l].map(c=>H([c,0,0]).applyMatrix4(s)))),this.write(o([this.at]).slice(1).split(" ").map(Number)),this.depth=t.depth(e,this.at)}write([t,e]){let{plan:n,wheel:s,ring:r}=this,o=Math.min(.03*n.width,1.6*s.radius/Math.max(2,s.id.length));this.name.textContent=!r&&s.radius>xb*n.width?s.id:"";for(let[a,l]of Object.entries({x:t,y:e+.36*o,"font-size":o}))this.name.setAttribute(a,l.toFixed(3))}},nu=class{constructor(t,e){Object.assign(this,{plan:t,dial:e,at:H(e.centre),frame:$t(e.centre,e.normal,e.zero)}),this.rim=Vt("path",{}),this.node=Vt("g",{class:"face"},Vt("title",{},e.title),this.rim)}draw(){let{plan:t,dial:e,at:n,frame:s}=this,r=a=>t.path(e.body,n,a),o=[.94,1.06].map(a=>H([a*e.radius,0,0]).applyMatrix4(s));this.rim.setAttribute("d",`${r(su(s,e.radius))}Z${r(o)}`),this.depth=t.depth(e.body,n)}},iu=class{constructor(t,{output:e,body:n,dial:s}){let{centre:r,normal:o,zero:a,radius:l}=t.scene.dials[s],c=$t(r,o,a);Object.assign(this,{plan:t,body:n,at:H(r)}),this.ends=[0,.9*l].map(h=>H([h,0,0]).applyMatrix4(c)),this.line=Vt("path",{}),this.node=Vt("g",{class:"pointing","data-output":e},Vt("title",{},e),this.line)}draw(){this.line.setAttribute("d",this.plan.path(this.body,this.at,this.ends)),this.depth=this.plan.depth(this.body,this.at)+1e-6}};function su(i,t){return Array.from({length:Bp},(e,n)=>{let s=2*Math.PI*n/Bp;return H([t*Math.cos(s),t*Math.sin(s),0]).applyMatrix4(i)})}var[yb,Mb]=[400,new nt(13n,64n)],bb=12,ru=8,[Sb,wb]=[.001,.1],Tb=.15,bl=({speed:i,sense:t})=>t*Number(nt.parse(i)??0);function Sl(i){return Math.min(wb,Math.max(Sb,Tb/Math.max(1,...i.pointers.map(t=>Math.abs(bl(t))))))}function Eb(i,t){let e=[0,1,...i.map(([n,s])=>((n*t+s)%1+1)%1)].sort((n,s)=>n-s);return Math.min(...e.slice(1).map((n,s)=>n-e[s]))*(i.length+1)}function wl(i){if(i.run||i.driving_link===null)return nt.of(0);let t=i.dials.length?i.dials.map((d,f)=>i.pointers.filter(({dial:m})=>m===f)):[i.pointers],e=({body:d,base:f,sense:m})=>m*(i.bodies[d].start-i.bodies[f].start)/(2*Math.PI),n=d=>[...new Map(d.filter(bl).map(f=>[bl(f),[bl(f),e(f)]])).values()],s=t.map(n).filter(({length:d})=>d),r=nt.of(i.step),o=Mb.times(Math.abs(Number(r))<1?r:nt.of(1)),a=Number(o),l=d=>s.reduce((f,m)=>f*Eb(m,d*a),1),[c,h]=[0,0],u=i.hangers.length?bb:yb;for(let d=1;d<=u;d+=1)l(d)>h&&([c,h]=[d,l(d)]);return o.times(c)}function Tl({note:i,bodies:t,driving_link:e,pointers:n,dials:s,asks:r}){if(i)return/^.+?(?<!\b[A-Z])\.(?=\s+[A-Z0-9(]|\s*$)/s.exec(i)?.[0]??i;if(e===null||!r)return"";let o=n.filter(({dial:c})=>!s.length||c!==null).map(({output:c})=>c),a=o.length>ru?` and ${o.length-ru} more`:"",l=`${o.slice(0,ru).join(", ")}${a}`;return s.length?`${t[e].id} moves the hands of ${l}.`:`${t[e].id} drives ${l}.`}var Gp=["January","February","March","April","May","June","July","August","September","October","November","December"],Ab=new nt(4598321n,2n),Vp={julian:new nt(3442235n,2n),gregorian:new nt(3442239n,2n)},zp=10n**9n,Cb=/^([+-]?\d{1,10})-(\d{1,2})-(\d{1,2})(?:[T ](\d{1,2}):(\d{2}))?$/,Rb=/^(\d{1,2})\.? +([a-z]{3,9})\.? +(\d{1,10})(?: *(bc|bce|ad|ce))?(?:,? +(\d{1,2}):(\d{2}))?$/i,$r=(i,t)=>(i-(i%t+t)%t)/t,Hp=(i,t)=>i<t?i:t;function Wp({year:i,month:t,day:e,part:n,calendar:s}){let r=(t+9n)%12n,o=i-(t<3n?1n:0n),a=365n*o+$r(o,4n)+(153n*r+2n)/5n+e-1n,l=s==="gregorian"?$r(o,400n)-$r(o,100n):0n;return Vp[s].plus(a+l).plus(n)}function El(i,t=null){let e=t??(i.minus(Ab).numerator<0n?"julian":"gregorian"),n=i.minus(Vp[e]),s=n.floor,[r,o]=e==="gregorian"?Pb(s):Xp(s),a=(5n*o+2n)/153n;return{year:r+(a>9n?1n:0n),month:(a+2n)%12n+1n,day:o-(153n*a+2n)/5n+1n,part:n.minus(s),calendar:e}}function Xp(i){let t=$r(i,1461n),e=i-1461n*t,n=Hp(e/365n,3n);return[4n*t+n,e-365n*n]}function Pb(i){let t=$r(i,146097n),e=i-146097n*t,n=Hp(e/36524n,3n),[s,r]=Xp(e-36524n*n);return[400n*t+100n*n+s,r]}function Ib(i,t=null){let e=Lb(i.trim().replace("−","-"));if(!e)return null;let[n,s,r,o,a]=e;if(n>zp||-n>zp||Number(o??0)>23||Number(a??0)>59)return null;let l=o===void 0?new nt(1n,2n):new nt(60n*BigInt(o)+BigInt(a),1440n),c=n<1582n||n===1582n&&(s<10n||s===10n&&r<15n),h={year:n,month:s,day:r,part:l,calendar:t??(c?"julian":"gregorian")},u=El(Wp(h),t);return["year","month","day","calendar"].every(f=>u[f]===h[f])?h:null}function Lb(i){let t=Cb.exec(i);if(t)return[BigInt(t[1].replace("+","")),BigInt(t[2]),BigInt(t[3]),t[4],t[5]];let e=Rb.exec(i);if(!e)return null;let n=Gp.findIndex(r=>r.toLowerCase().startsWith(e[2].toLowerCase()))+1,s=BigInt(e[3]);return[/^b/i.test(e[4]??"")?1n-s:s,BigInt(n),BigInt(e[1]),e[5],e[6]]}function ts({year:i,month:t,day:e,part:n}){let s=n.times(1440n).floor,r=[s/60n,s%60n].map(a=>String(a).padStart(2,"0")).join(":"),o=i>0n?i<1000n?`${i} AD`:i:`${1n-i} BC`;return`${e} ${Gp[Number(t)-1]} ${o}, ${r}`}var jn=class{constructor({julian_day:t,turns:e,days:n,calendar:s,source:r,note:o,unset:a}){Object.assign(this,{calendar:s,source:r,note:o,known:!a.length}),[this.day,this.turns,this.days]=[t,e,n].map(l=>nt.of(l))}dayAt(t){return this.day.plus(t.minus(this.turns).times(this.days))}dateAt(t){return El(this.dayAt(t),this.calendar)}turnsAt(t){return this.turns.plus(Wp(t).minus(this.day).over(this.days))}read(t){return Ib(t,this.calendar)}};var Yp=2*Math.PI,qp=36525,Al=i=>i*Math.PI/180;function Zp(i){let t=(Number(i)-23858005e-1)/qp;return(Number(i)+(32*t*t-20)/86400-2451545)/qp}var fi=(i,t)=>i.reduceRight((e,n)=>e*t+n,0),Cl=()=>new nt(BigInt(Date.now()),86400000n).plus(new nt(4881175n,2n));function Jp(i,t,e){let n=Zp(e);if(t==="moon_node")return fi(i.moon.node,n);if(t==="moon")return Db(i,n);let[s,r]=$p(i.earth,n),[o,a]=t==="sun"?[0,0]:$p(i[t],n);return Math.atan2(a-r,o-s)*360/Yp}function $p(i,t){let[e,n,s,r]=["longitude","perihelion","eccentricity","distance"].map(d=>fi(i[d],t)),o=Al((e-n)%360),a=o;for(let d=0;d<20;d+=1)a-=(a-s*Math.sin(a)-o)/(1-s*Math.cos(a));let[l,c]=[r*(Math.cos(a)-s),r*Math.sqrt(1-s*s)*Math.sin(a)],[h,u]=[Math.cos(Al(n)),Math.sin(Al(n))];return[h*l-u*c,u*l+h*c]}function Db({moon:i,earth:t},e){let n=fi(i.longitude,e),[s,r,o,a]=[n-fi(i.perigee,e),n-fi(t.longitude,e)-180,fi(t.longitude,e)-fi(t.perihelion,e),n-fi(i.node,e)];return[[6.288774,s],[1.274027,2*r-s],[.658314,2*r],[.213618,2*s],[-.185116,o],[-.114332,2*a]].reduce((c,[h,u])=>c+h*Math.sin(Al(u)),n)}var Vs=({epoch:i},t)=>nt.of(i.turns).plus(t.minus(i.julian_day).over(i.days)),ou=i=>i.epoch?.settings.length?Vs(i,i.epoch.day??nt.of(i.epoch.julian_day)):nt.of(0);function Rl(i,t){let e=Nb(i,t),n=i.bodies.map((o,a)=>o.sense*(e[a]-o.start)),s=(o,a)=>n[o]-n[a],r=o=>o&&{...o,sources:o.sources.map(a=>Ob(i,a,s))};return{...i,epoch:{...i.epoch,day:t},bodies:i.bodies.map((o,a)=>({...o,start:e[a]})),wheels:i.wheels.map((o,a)=>Ub(i,o,a,s)),couplings:i.couplings.map(o=>({...o,slot_turn:(o.slot_turn??0)+Kp(o,s)})),movement:r(i.movement),back:r(i.back)}}function Nb(i,t){let[e,n]=[Zp(t),Vs(i,t)],s=i.bodies.map(r=>r.start);for(let{pointer:r,sense:o,angle:a}of i.epoch.settings){let{body:l,base:c,speed:h,dial:u}=i.pointers[r],d=nt.of(h??"0").times(n),f=BigInt(u===null?1:i.dials[u].scale.turns),m=Number(d.floor%f)+d.part;s[l]=Yp*((o*fi(a,e)/360-m)%Number(f))+i.bodies[l].sense*i.bodies[c].sense*s[c]}for(let{kind:r,pin:o,slot:a}of i.couplings){let l=i.epoch.settings.some(({pointer:c})=>i.pointers[c].body===a);r==="pin_and_slot"&&!l&&(s[a]+=i.bodies[a].sense*i.bodies[o].sense*(s[o]-i.bodies[o].start))}return s}function Ob(i,t,e){let n=i.couplings.find(({id:l})=>l===t.pair);if(!n)return t;let s=t.bodies.includes(n.slot)?n.pin:n.slot,[r,o]=[s,n.carrier].map(l=>i.bodies[l].sense*Number(nt.of(i.bodies[l].speed??0))),a=(r<o?-1:1)*Math.sign(Number(nt.of(i.step)));return{...t,start:t.start+a*e(s,n.carrier)}}var Kp=({kind:i,pin:t,slot:e,carrier:n},s)=>(i==="pin_follower"?0:s(t,n))-s(e,n);function Ub(i,t,e,n){let s=i.pairs.find(({wheels:l})=>l.includes(e)),r=i.couplings.find(({slot:l})=>l===t.body),o=s?-n(t.body,s.carrier):0,a=r&&t.holes.length?Kp(r,n)-o:0;return{...t,turn:t.turn+o,holes:a?t.holes.map(l=>Fb(l,a)):t.holes}}var Fb=(i,t)=>i.map((e,n)=>n%2?Math.sin(t)*i[n-1]+Math.cos(t)*e:Math.cos(t)*e-Math.sin(t)*i[n+1]);var Bb=60;function jp(i){return i.trim().length>Bb||/e[+-]?\d{3,}/i.test(i)?null:nt.parse(i)}var Fn=i=>String(i).replace(/^-/,"−");function Hs({numerator:i,denominator:t},e=4){let n=10n**BigInt(e),r=(2n*(i<0n?-i:i)*n+t)/(2n*t),o=String(r%n).padStart(e,"0").replace(/0+$/,""),a=String(r/n).replace(/\B(?=(\d{3})+$)/g," ");return(i<0n&&r?"−":"")+a+(o?`.${o}`:"")}function Yr(i){return i.denominator!==1n&&i.denominator<10000n&&i.toString().length<=14?`${Hs(i)} = ${Fn(i)}`:Hs(i)}var kb="Set the pointers to the sky at this moment",zb=100,Ws="M7 4.5v15l12.5-7.5z",Jr="M7 5h3.6v14H7zM13.4 5H17v14h-3.6z";function Qp(i){let t=i.crank===null?null:nt.parse(i.bodies[i.crank].speed),e=t?Math.abs(Number(t)):1;return e>=.05&&e<=20?e:1}var Zr=class{constructor(t,e,{beside:n="",set:s=null}={}){if(this.scene=t,this.drive=e,this.gearing=Qp(t),this.lead=t.driving_link===null?"the input":t.bodies[t.driving_link].id,this.onSet=s,this.epoch=t.epoch?new jn(t.epoch):null,this.date=this.epoch&&M("output",{class:"date","aria-live":"off"}),this.wheel=this.#t(),this.playing=M("button",{type:"button",class:"round",onclick:()=>e.play()}),this.turns=M("output",{class:"turns","aria-live":"off"}),this.fault=M("p",{class:"bad",role:"alert",id:"go-fault",hidden:!0}),this.node=M("section",{class:"crank","aria-label":"crank"},this.wheel,M("div",{class:"where"},this.turns,M("span",{class:"quiet"},`turns of ${this.lead}`),this.date,n&&M("span",{class:"quiet beside-it"},n)),M("div",{class:"buttons"},M("button",{type:"button",onclick:()=>e.unit(-1),"aria-label":"one unit of the input back"},mn("M6 5v14M19 5l-9 7 9 7z")),this.playing,M("button",{type:"button",onclick:()=>e.unit(1),"aria-label":"one unit of the input forward"},mn("M18 5v14M5 5l9 7-9 7z")),this.#o()),this.#n(),this.#s(),this.epoch?.known&&this.#a(),this.fault),!e.movable)for(let r of this.node.querySelectorAll("button, input"))r.disabled=!0}#t(){let t=[0,60,120,180,240,300].map(n=>Vt("path",{d:"M0-7V-33",transform:`rotate(${n})`}));this.hand=Vt("g",{},Vt("circle",{class:"felloe",r:36}),...t,Vt("circle",{class:"hub",r:7}),Vt("circle",{class:"knob",cy:-36,r:8}));let e=Vt("svg",{viewBox:"-50 -50 100 100",class:"handle",tabindex:this.drive.movable?0:-1,role:"slider","aria-label":`crank, turns of ${this.lead}`,"aria-valuenow":0,"aria-disabled":this.drive.movable?null:"true"},this.hand);return e.addEventListener("pointerdown",n=>this.#e(n)),e}#e(t){if(!this.drive.movable)return;let e=this.wheel.getBoundingClientRect(),n=a=>Math.atan2(a.clientY-e.top-e.height/2,a.clientX-e.left-e.width/2),s=n(t);this.wheel.setPointerCapture(t.pointerId);let r=a=>{let l=n(a),c=(l-s)/(2*Math.PI);s=l,this.drive.advance((c-Math.round(c))/this.gearing)},o=()=>{this.wheel.removeEventListener("pointermove",r),this.drive.advance(0,!0)};this.wheel.addEventListener("pointermove",r),this.wheel.addEventListener("lostpointercapture",o,{once:!0}),t.preventDefault(),this.wheel.focus({preventScroll:!0})}#n(){let{drive:t}=this,[e,n]=this.epoch?["days",Math.abs(Number(this.epoch.days))]:["turns",1],s=M("input",{type:"range",min:-3,max:2,step:.1}),r=M("input",{type:"number",class:"pace",min:0,step:"any","aria-label":`${e} a second`}),o=(a,l=!1)=>{t.rate=a;let c=Number((a*n).toPrecision(2));l||(r.value=c),s.value=Math.log10(a),s.setAttribute("aria-valuetext",`${c} ${e} a second`)};return s.addEventListener("input",()=>o(10**Number(s.value))),r.addEventListener("input",()=>Number(r.value)>0&&o(Number(r.value)/n,!0)),o(t.rate),ke("Speed",M("span",{class:"with"},s,r,`${e}/s`),{class:"field speed"})}#s(){return this.place=M("input",{type:"text",inputmode:"text",placeholder:"235/19",autocomplete:"off",spellcheck:"false","aria-describedby":"go-fault"}),M("form",{class:"go",onsubmit:t=>this.#r(t)},ke("Go to turn",this.place),M("button",{type:"submit"},"Go"))}#r(t){t.preventDefault();let e=jp(this.place.value);this.#i(this.place,e,"This is not a number of turns; write 12, 2.5, 235/19 or 1e6."),e&&this.drive.play(!1),e&&this.drive.goTo(e)}#i(t,e,n){this.fault.hidden=!!e,t.setAttribute("aria-invalid",String(!e)),this.fault.textContent=e?"":n}turnBack(){this.drive.sense*=-1,this.back.setAttribute("aria-pressed",String(this.drive.sense<0))}#o(){return this.back=M("button",{type:"button","aria-pressed":String(this.drive.sense<0),"aria-label":"play backwards",title:"Play backwards",onclick:()=>this.turnBack()},mn("M4 5v5h5M4.5 10a8 8 0 1 1-.5 5")),this.back.firstChild.classList.add("line"),this.back}#a(){let t=M("input",{type:"text",placeholder:"-204-05-12",autocomplete:"off",spellcheck:"false",maxlength:40,"aria-describedby":"go-fault"}),e=()=>{let r=this.epoch.read(t.value);return this.#i(t,r,"This is not a date; write -204-05-12 or 12 May 205 BC, optionally followed by 18:30."),r&&this.epoch.turnsAt(r)},n=r=>{r.preventDefault();let o=e();o&&this.drive.play(!1),o&&this.drive.goTo(o)},s=()=>{let r=e();r&&this.drive.runTo(r)};return M("form",{class:"go day",onsubmit:n},ke("Go to date",t),M("button",{type:"submit"},"Go"),M("button",{type:"button",onclick:s,title:"Run to this date in eight seconds"},"Run"),M("button",{type:"button",onclick:()=>this.#l(),title:kb},"Today"))}#l(){let t=Cl();this.drive.play(!1),this.scene.epoch.settings.length&&this.onSet?.(t),this.drive.goTo(Vs(this.scene,t))}#c(t){if(this.date.title=this.epoch.known?"":`Without a position in the sky: ${this.scene.epoch.unset.join(", ")}`,this.date.textContent="not set to the sky",!this.epoch.known)return;let e=this.epoch.dateAt(t);this.dated=performance.now(),this.date.textContent=ts(e),this.date.title=`${e.calendar==="julian"?"Julian":"Gregorian"} calendar`}find(){this.place.focus(),this.place.select()}use(t){this.scene=t,this.gearing=Qp(t);for(let e of this.node.querySelectorAll("button, input"))e.disabled=!this.drive.movable}set(t,e){let{part:n}=t.at,s=Number(t.at.floor%1000000n);this.hand.setAttribute("transform",`rotate(${((s+n)*this.gearing*360%360).toFixed(3)})`),this.turns.textContent=Yr(t.at),this.date&&(e||performance.now()-(this.dated??0)>zb)&&this.#c(t.at),(e||!t.playing)&&(this.wheel.setAttribute("aria-valuenow",String(Number(t.at))),this.wheel.setAttribute("aria-valuetext",`${Yr(t.at)} turns`)),this.shown!==t.playing&&(this.shown=t.playing,this.playing.replaceChildren(mn(t.playing?Jr:Ws)),this.playing.setAttribute("aria-label",t.playing?"pause":"play"))}};var Pl=14,Gb=1/25,Vb=new nt(1n,72n),Xs=class{constructor(t,e){this.app=t,this.step=e,this.at=nt.parse(t.turns)??nt.of(0),this.rate=.1,this.playing=!1,this.sense=1,this.movable=!0,this.run=null,this.loop=!0,this.listeners=[],this.calm=matchMedia("(prefers-reduced-motion: reduce)"),t.onTurns=n=>this.#i(n)}listen(t){this.listeners.push(t)}goTo(t,e=!0){this.movable&&(this.at=this.#e(t),this.setting=!0,this.app.setTurns(this.at.toString()),this.setting=!1,this.#r(e))}advance(t,e=!1){this.goTo(this.at.plus(nt.near(t,this.run?Pl:void 0)),e)}unit(t){this.run?this.goToTime(this.run.blowFrom(this.time,t)):this.goTo(this.at.plus(this.step.times(t)))}nudge(t){this.goTo(this.at.plus(this.run?nt.near(t*Gb*this.rate,Pl):Vb.times(t)))}goToTime(t,e=!0){this.goTo(nt.near(t/this.run.period,Pl),e)}get time(){return Number(this.at)*this.run.period}get#t(){return nt.near(this.run.duration/this.run.period,Pl)}#e(t){return this.run?t.numerator<0n?nt.of(0):t.minus(this.#t).numerator>0n?this.#t:t:t}play(t=!this.playing){t&&this.movable&&this.#s&&this.goTo(nt.of(0),!1),this.#n(t,e=>this.calm.matches&&e<1e3?!1:(this.loop&&this.#s?this.goTo(nt.of(0),!1):this.advance(this.sense*this.rate*Math.min(e,this.calm.matches?2e3:100)/1e3),!this.loop&&this.#s&&this.play(!1),!0))}runTo(t,e=8){if(this.calm.matches)return this.goTo(t);let n=this.at,s=t.minus(n),r=0;this.#n(!0,o=>(r+=Math.min(o,100)/1e3/e,r>=1&&this.#n(!1),this.goTo(r<1?n.plus(s.times(nt.near(r))):t,r>=1),!0))}#n(t,e){this.playing=t&&this.movable,this.#r(!this.playing);let n=this.frames={},s=performance.now(),r=o=>{!this.playing||this.frames!==n||(e(o-s)&&(s=o),requestAnimationFrame(r))};this.playing&&requestAnimationFrame(r)}get#s(){return!!this.run&&this.at.equals(this.#t)}#r(t){for(let e of this.listeners)e(this,t)}#i(t){this.setting||(this.play(!1),this.at=nt.parse(t)??this.at,this.#r(!0))}};var Hb={zero:!1,carrier:null},Wb=10n**12n,Xb={kind:"exact",why:"",transmissions:[],sources:[],steps:[],offsets:{},period:null},Il=class{constructor(t){this.scene=t,this.given=t.formulas,this.declared=this.given.wheels.map((e,n)=>BigInt(t.wheels[this.given.count.indexOf(n)].teeth)),this.driven=nt.of(this.given.input)}at(t){return this.given.count[t]}solve(t){let e=this.given.conditions.filter(({formula:o,zero:a})=>Yb(o,t)!==a),n=this.given.formulas.map(o=>$b(o,t));n.includes(null)&&!e.length&&e.push(Hb);let s=e.length?n.map(()=>null):n,r=o=>o===null?null:s[o];return{bodies:this.given.bodies.map(r),pointers:this.given.pointers.map(r),broken:e}}changed(t){let{scene:e}=this,{bodies:n,pointers:s,broken:r}=this.solve(t),[o,a]=this.#e(t),l=r.length>0||e.movement.kind==="still";return{...e,bodies:e.bodies.map((c,h)=>c.parent===null?c:{...c,...this.#t(n[h])}),pointers:e.pointers.map((c,h)=>({...c,...this.#t(s[h]),text:Jb(c.sense,s[h])})),wheels:Qb(e,a),profiles:o,pairs:e.pairs.map(c=>({...c,text:jb(c,e.wheels,a)})),movement:{...Xb,kind:l?"still":"mean",why:l?"":lu},back:null,verdict:r.length?Kb(e,r):e.verdict,changed:!0}}#t(t){if(t===null)return{speed:null,shown:null,decimal:""};let e=Zb(t);return{speed:t.over(this.driven).toString(),shown:this.given.exact?t.toString():e,decimal:e}}#e(t){let e=[...this.scene.profiles],n=this.scene.wheels.map((s,r)=>{let o=this.at(r),a=o===null?s.teeth:Number(t[o]);if(a===s.teeth)return s;if(s.kind==="worm")return{...s,teeth:a};let l=a/s.teeth,{points:c,...h}=e[s.profile];e.push({...h,points:c.map(([x,p])=>[1+(x-1)/l,p/l])});let[u,d,f]=[l*s.radius,s.tip,s.root],m=u-s.radius;return{...s,teeth:a,radius:u,tip:d+m,root:f+m,profile:e.length-1}});return[e,n]}meshes(t){let{scene:e}=this,n=s=>this.at(s)===null?BigInt(e.wheels[s].teeth):t[this.at(s)];return e.pairs.map(s=>{let[r,o]=s.wheels.map(d=>e.wheels[d]),a=s.wheels.map(d=>n(d)-BigInt(e.wheels[d].teeth)),l=2*r.radius/r.teeth;if(!a[0]&&!a[1])return{pair:s,off:nt.of(0),module:l};let c=[r,o].findIndex(({kind:d})=>d==="worm");if(c>=0)return{pair:s,off:new nt(a[1-c],2n),module:2*[o,r][c].radius/[o,r][c].teeth};if(!he(r.direction,o.direction))return{pair:s,off:null,apart:qb(r,o)?this.#n(s,a):null};let h=[r,o].findIndex(({kind:d})=>d==="ring"),u=h<0?a[0]+a[1]:a[h]-a[1-h];return{pair:s,off:new nt(u,2n),module:l}})}#n({wheels:t},e){return t.reduce((n,s,r)=>n+Number(e[r])*this.scene.wheels[s].radius/this.scene.wheels[s].teeth,0)}},qb=(...i)=>i.every(({cone:t,kind:e})=>!t&&e!=="contrate"),lu="The motion of teeth and pins was computed only for the declared counts, so mean motion is shown.";function tm(i){let t=String(i).trim(),e=/^\d{1,13}$/.test(t)?BigInt(t):0n;return e>0n&&e<=Wb?e:null}function au(i,t,e){let n=0n;for(let[s,r]of i){let o=BigInt(s);r.forEach((a,l)=>o*=e[t[l]]**BigInt(a)),n+=o}return n}function $b({wheels:i,numerator:t,denominator:e},n){let s=au(e,i,n);return s===0n?null:new nt(au(t,i,n),s)}var Yb=({wheels:i,numerator:t},e)=>au(t,i,e)===0n;function Zb(i){let[t,e]=Number(i).toPrecision(10).split("e"),n=t.includes(".")?t.replace(/\.?0+$/,""):t;return e?`${n}e${e}`:n}function Jb(i,t){return t===null?"":t.numerator===0n?"at rest":`${t.numerator>0n==i>0?"clockwise":"counter-clockwise"} as read`}function Kb(i,t){let e=({carrier:r})=>r!==null&&i.bodies[r].parent===null,n=t.map(r=>{let{text:o,zero:a,carrier:l}=r;if(!a)return"with these counts the train is locked or free";if(l===null)return`no longer satisfied: ${o}`;let c=e(r)?"lock each other":`can only turn with ${i.bodies[l].id} as one body`;return`${o.replace(/ closes$/,"")} no longer closes: its wheels ${c}`});return{kind:t.some(e)?"locked":"not determined",text:`${[...new Set(n)].join("; ")}. Save the train and run \`geartrain solve\` to see which links still turn.`,links:[],loops:[],advice:[]}}function jb({text:i,wheels:t},e,n){let s=0;return i.replace(/(?<= [+-] |^)(\d+) \(/g,(r,o)=>{let a=t[s++];return a!==void 0&&Number(o)===e[a].teeth?`${n[a].teeth} (`:r})}function Qb(i,t){let e=[...t],n=t.map(()=>[]);i.pairs.forEach(({wheels:[r,o]})=>{n[r].push(o),n[o].push(r)});let s=new Set;return t.forEach((r,o)=>{if(s.has(o))return;let a=[o];s.add(o);for(let c of a)for(let h of n[c])s.has(h)||a.push((s.add(h),h));if(a.every(c=>t[c]===i.wheels[c]))return;let l=new Set([o]);for(let c of a)for(let h of n[c])l.has(h)||(l.add(h),e[h]=tS(e[h],e[c]))}),e}function tS(i,t){let e=H(t.centre).sub(H(i.centre)),n=H(i.direction);if(e.addScaledVector(n,-e.dot(n)),!he(i.direction,t.direction)||e.length()<1e-9)return i;let s=i.kind==="ring"||t.kind==="ring",r=e.normalize().multiplyScalar(t.kind==="ring"?-1:1),o=s?r:r.clone().negate(),a=n.dot(H(t.direction))>0?1:-1,c=(s?a:-a)*eS(t,o)+.5;return{...i,turn:em(i,r)+2*Math.PI*c/i.teeth}}var eS=(i,t)=>(i.turn-em(i,t))*i.teeth/(2*Math.PI);function em({direction:i,reference:t},e){let n=H(t);return Math.atan2(H(i).cross(n).dot(e),n.dot(e))}async function Kr(i){try{return await navigator.clipboard.writeText(i),!0}catch{let t=M("textarea",{class:"unseen","aria-hidden":"true"});t.value=i,document.body.append(t),t.select();let e=document.execCommand("copy");return t.remove(),e}}function qs(i,t){let e=M("button",{type:"button",class:"copy",title:`Copy ${i}`,"aria-label":`${i}, copy`},Fn(i).split(/(?<=\/)/).flatMap(n=>[n,M("wbr")]));return e.addEventListener("click",async n=>{n.stopPropagation();let s=document.activeElement,r=await Kr(i);s instanceof HTMLElement&&s.focus({preventScroll:!0}),e.classList.toggle("copied",r),t(r?`${i} copied`:"the browser does not permit copying"),setTimeout(()=>e.classList.remove("copied"),1200)}),e}var nS=36525,cu=({pointers:i,epoch:t})=>i.some(({targets:e})=>e.length)||!!(t&&(t.settings.length||t.unset.length));function im(i,t,e){let n=ou(i.machine.scene),s=nt.of(t.speed).times(e.minus(n)).plus(nt.of(i.pointer.speed).times(n));return Ui(i.sense*(Number(s.floor%BigInt(i.turns))+s.part)+i.start,i.turns)}var jr=({epoch:i},t)=>i?.settings.find(({pointer:e})=>e===t)?.body||void 0;function sm({machine:i,index:t}){let{epoch:e}=i.scene;return Ui(Jp(e.elements,jr(i.scene,t),new jn(e).dayAt(i.made()))/360,1)}var rm=i=>jr(i.machine.scene,i.index)?sm(i):im(i,i.pointer.targets[0],i.machine.made()),nm=(i,t,e)=>nt.of(i.speed).minus(t.speed).times(e);function Ll(i){let t=Number(i)*360;if(!t)return"0°";let e=Math.abs(t),n=e<5e-5||e>=1e6?e.toExponential(1):e<5e-4?e.toFixed(4):e<100?e.toFixed(3):e<1e3?e.toFixed(2):e.toFixed(0);return`${t<0?"−":"+"}${n}°`}var Dl=class{constructor(t,{say:e,onSet:n}){Object.assign(this,{say:e,onSet:n,rows:[],heavens:[]}),this.node=M("div",{},t.map(s=>this.#t(s,t.length>1)))}#t(t,e){let{scene:n}=t;if(!cu(n))return e&&M("p",{class:"quiet"},`${t.label} has no targets.`);let r=["output, target","pointer","target","pointer ahead",n.unit_days===null?"per unit":"per century"];return[e&&M("h3",{},t.label),n.epoch&&sS(n),n.epoch?.settings.length>0&&this.#e(t),M("p",{class:"tells quiet"},"The sky is the true geocentric longitude from the equinox of the date (of the Moon's node, the mean longitude). Targets are mean motions without anomalies, which agree with the pointers when these are set. Errors of targets are exact; click one to copy it in turns."),M("div",{class:"scroll",tabindex:0,role:"region","aria-label":"targets"},M("table",{class:"sky"},M("thead",{},M("tr",{},r.map(o=>M("th",{scope:"col"},o)))),M("tbody",{},n.pointers.flatMap((o,a)=>[this.#n(t,a),...o.targets.map(l=>this.#s(t,a,l))]))))]}#e({scene:t,machine:e}){let n=new jn(t.epoch),s=nt.of(t.epoch.day??t.epoch.julian_day),r=M("button",{type:"button",class:"small"},"Set at the displayed date");return r.addEventListener("click",()=>this.onSet(n.dayAt(e.made()))),M("p",{class:"set"},`Pointers set to the sky: ${ts(El(s,n.calendar))} `,r)}#n(t,e){let{scene:n,machine:s}=t,{output:r}=n.pointers[e],o=jr(n,e),a=n.epoch?.unset.includes(r);if(!o&&!a)return null;let l=[0,1,2].map(()=>M("td",{class:"angle"}));return a?l[1].textContent="not set to the sky":this.heavens.push({reading:new sn(n,s,e),cells:l}),M("tr",{"data-heaven":r},M("th",{scope:"row"},r,M("div",{class:"quiet"},o==="moon_node"?"the sky, mean node":"the sky")),l,M("td",{class:"angle"},"–"))}#s(t,e,n){let{scene:s,machine:r}=t,o=s.pointers[e],[a,l]=[M("td",{class:"angle"}),M("td",{class:"angle"})],c=M("button",{type:"button",class:"copy"});c.addEventListener("click",async()=>{let u=c.dataset.exact;this.say(await Kr(u)?`${u} turns copied`:"the browser does not permit copying")});let h=s.unit_days===null?nt.of(s.step):nt.of(s.step).times(nS).over(s.unit_days);return this.rows.push({reading:new sn(s,r,e),target:n,own:a,sky:l,error:c,machine:r}),M("tr",{"data-pointer":o.output,"data-target":n.label},M("th",{scope:"row"},o.output,M("div",{class:"quiet"},iS(n.label))),a,l,M("td",{class:"angle"},c),M("td",{class:"angle"},Ll(nm(o,n,h))))}set(t){if(!(!t||!this.node.offsetParent)){for(let{reading:e,cells:n}of this.heavens){let s=[e.now.degrees,sm(e)*360],r=Ui(s[0]-s[1]+180,360)-180;n.forEach((o,a)=>o.textContent=a<2?ks(s[a]):Ll(r/360))}for(let{reading:e,target:n,own:s,sky:r,error:o,machine:a}of this.rows){let l=a.made(),c=nm(e.pointer,n,l.minus(ou(a.scene)));s.textContent=ks(e.now.degrees),r.textContent=ks(Ui(im(e,n,l),1)*360),o.textContent=Ll(c),o.dataset.exact=c.toString(),o.title=`${Fn(c.toString())} turns`,o.setAttribute("aria-label",`${Ll(c)} ahead, copy the exact turns`)}}}},iS=i=>i.split(/(?<=_)/).flatMap(t=>[t,M("wbr")]);function sS(i){let t=new jn(i.epoch),e=i.bodies[i.driving_link].id,n=t.turns.numerator===0n?`${e} had made no turns`:`${e} had made ${t.turns} turns`,s=t.dateAt(t.turns),r=i.sources[t.source]?.cite,o=s.calendar==="julian"?"Julian":"Gregorian";return M("p",{class:"epoch"},`${n} on ${ts(s)} (${o} calendar).`,t.note&&` ${t.note}`,t.source&&M("span",{class:"quiet"},` ${t.source}${r?`: ${r}`:""}`))}var es=90,hu=(i,t,e)=>{let n=2*Math.PI*i+e;return[t*Math.sin(n),-t*Math.cos(n)]},Qr=i=>`${i[0].toFixed(2)} ${i[1].toFixed(2)}`,rS=i=>`M${Kh(i).map(([t,e])=>Qr([es*t,-es*e])).join("L")}`;function oS(i){let[t,,e]=i.normal,n=[e,0,-t],s=Math.hypot(...n);if(s<1e-6)return 0;let r=(i.zero[0]*n[0]+i.zero[2]*n[2])/s;return Math.atan2(r,i.zero[1])}var Nl=class{constructor(t,e,n){this.scale=e.scale,this.engraving=e.engraving,this.zero=oS(e),this.hands=n.map(s=>({reading:s,node:this.#n(s),sky:this.#s(s)})),this.node=Vt("svg",{viewBox:"-100 -100 200 200",class:"dial",role:"img","aria-label":`dial ${t}`},Vt("circle",{r:97,class:"face"}),...this.#e(),...this.hands.flatMap(s=>s.sky??[]),...this.hands.map(s=>s.node),Vt("circle",{r:3.2,class:"boss"}))}#t(t){let{inner:e,outer:n,turns:s}=this.scale;return es*(e+(n-e)*t/s)}#e(){let t={transform:`rotate(${(this.zero*180/Math.PI).toFixed(6)})`},e=this.engraving.map(([r,o,a])=>Vt("path",{class:r,"stroke-width":(o*es).toFixed(3),d:a.map(rS).join("")})),n=[-.011,.011].map(r=>Qr(hu(r,es+8,0))),s=Vt("path",{class:"zero",d:`M${n[0]}L${n[1]}L${Qr(hu(0,es+1.5,0))}Z`});return[Vt("g",t,...e,s)]}#n(t){let{order:e}=t,n=Vt("g",{class:`hand hand-${e%nn.length}`,"data-output":t.pointer.output});return this.draw(n,t,e),n}#s({order:t,pointer:e,machine:n,index:s}){let[r]=e.targets;if(!r)return null;let o=Vt("title",{},jr(n.scene,s)?`${e.output} in the sky`:`${e.output} by ${r.label}, mean motion`);return Vt("circle",{class:`target hand-${t%nn.length}`,r:4,"data-output":e.output},o)}draw(t,{pointer:e},n){let s=this.scale.turns>1,r=jh(e,es*this.scale.outer,n),o=r.map(([l,c])=>Qr([c,-l])),a=r.map(([l,c])=>Qr([-c,-l])).reverse();t.append(Vt("path",{class:"needle",d:s?"":`M${[...o,...a].join("L")}Z`})),s&&t.append(Vt("circle",{class:"follower",r:3}))}#r(t,e){let[n,s]=hu(this.scale.way*e,this.#t(e),this.zero);t.setAttribute("cx",n.toFixed(3)),t.setAttribute("cy",s.toFixed(3)),t.setAttribute("data-turns",e.toFixed(12))}#i(t,e){let n=(2.6-e).toFixed(3);t.querySelector(".needle").setAttribute("d",`M-1.6 14L-1.1 ${n}L1.1 ${n}L1.6 14Z`),t.querySelector(".follower").setAttribute("cy",(-e).toFixed(3))}set(){for(let{reading:t,node:e,sky:n}of this.hands){let s=t.now;if(n&&this.#r(n,rm(t)),e.classList.toggle("unknown",!s),!s)continue;let r=(this.scale.way*s.degrees+this.zero*180/Math.PI)%360;e.setAttribute("transform",`rotate(${r.toFixed(6)})`),e.setAttribute("data-turns",s.turns.toFixed(12)),this.scale.turns>1&&this.#i(e,this.#t(s.turns))}}};var aS=4;function uu(i,t){let[e,n]=[nt.parse(i),nt.parse(t)];if(!e||!n)return null;let s=n.minus(e);return{gap:s.toString(),part:e.numerator===0n?null:Number(s.over(e))}}function du(i){if(i===null||i===0)return"";let t=Math.abs(i),e=t<.001?`${(t*1e6).toPrecision(3)} ppm`:`${(t*100).toPrecision(3)} %`;return`${i<0?"−":"+"}${e}`}function lS({bodies:i,pointers:t}){let[e,n]=[t.length,i.length-1];return`This train declares no outputs; ${e<n?`the first ${e} of its ${n} links are listed`:"its links are listed"}.`}var Ol=class{constructor(t,{onChoose:e,onSet:n,say:s}){Object.assign(this,{sides:t,onChoose:e,say:s}),this.dials=[],this.angles=[],this.rows=[],this.names=[...new Set(t.flatMap(o=>o.scene.pointers.map(a=>a.output)))],this.one=t.every(o=>o.scene.unit===t[0].scene.unit);let r=t.some(({scene:o})=>o.epoch?.settings.length)?"the sky and targets":"targets";this.sky=t.some(({scene:o})=>cu(o))&&new Dl(t,{say:s,onSet:n}),this.comparison=this.sky&&Qh(`Comparison with ${r}`,this.sky.node,()=>this.set(!0)),this.search=M("input",{type:"search",placeholder:"Find an output","aria-label":"find an output",oninput:()=>this.#l()}),this.node=M("div",{},this.names.length>12&&this.search,!this.one&&M("p",{class:"note"},"The two trains use different units of speed, so no differences are shown."),t.map(({scene:o})=>!o.asks&&M("p",{class:"quiet"},lS(o))),this.#t(),this.comparison)}#t(){let t=[...new Set(this.sides.flatMap(({scene:o})=>o.dials.map(({title:a})=>a)))],e=t.map(o=>({title:o,names:this.names.filter(a=>this.#e(a)===o)})),n=this.names.filter(o=>!this.#e(o)),s=[t.length&&this.#n(e.flatMap(({title:o,names:a})=>[this.#s(o),...a.map(l=>this.#i(l))]))];if(!n.length)return s;let r=this.#n(n.map(o=>this.#i(o)));return t.length?(this.others=Qh(`${n.length} outputs without a dial`,r,()=>this.set(!0)),[...s,this.others]):r}#e(t){return this.sides.map(({scene:n})=>n.dials[n.pointers.find(({output:s})=>s===t)?.dial]).find(Boolean)?.title??""}#n(t){let e=this.sides.length>1,n=[...this.sides.flatMap(({label:s})=>e?[s,"speed"]:["reading","speed, exact"]),e&&"difference"];return M("div",{class:"scroll",tabindex:0,role:"region","aria-label":"outputs"},M("table",{class:"outputs"},M("caption",{class:"unseen"},"Outputs; choose one to see its path from the input"),M("thead",{},M("tr",{},["output",...n].filter(Boolean).map(s=>M("th",{scope:"col"},s)))),M("tbody",{},t)))}#s(t){let e=this.sides.flatMap(({scene:n,machine:s,label:r})=>{let o=n.dials.find(l=>l.title===t),a=n.pointers.map((l,c)=>new sn(n,s,c)).filter(l=>o&&l.dial===o);return a.length?[this.#r(o,a,this.sides.length>1&&r)]:[]});return M("tr",{class:"faces"},M("td",{colspan:this.sides.length>1?6:3},M("div",{class:"cards"},e)))}#r(t,e,n){let s=new Nl(t.title,t,e);this.dials.push(s);let{divisions:r,turns:o,cell:a,names:l}=t.scale,c=r>1&&`${r} ${a}s${o>1?` on ${o} turns`:""}`;return M("figure",{class:l.length>aS||e.length>2?"card wide":"card"},s.node,M("figcaption",{},M("strong",{},t.title),[n,c,t.look==="scale"&&!t.placed&&"layout computed",t.note].filter(Boolean).map(h=>M("span",{class:"quiet said"},h))))}#i(t){let e=this.sides.map(h=>h.scene.pointers.findIndex(u=>u.output===t)),n=e.map((h,u)=>this.sides[u].scene.pointers[h]),s=this.sides.map(({scene:h,machine:u},d)=>n[d]&&new sn(h,u,e[d])),r=s.find(h=>h?.dial),o=M("button",{type:"button",class:"plain","aria-pressed":"false",onclick:()=>this.onChoose(t)},r&&M("span",{class:`key hand-${r.order%nn.length}`,"aria-hidden":"true"}),t),a=s.flatMap(h=>this.#o(h));this.sides.length>1&&a.push(this.#a(n));let l=n.map(h=>h?.note).find(Boolean),c=M("tr",{"data-output":t},M("th",{scope:"row",title:l},o),a);return this.rows.push({name:t,row:c,pick:o}),c}#o(t){if(!t)return[0,1].map(()=>M("td",{class:"quiet"},"–"));let{pointer:e}=t,n=M("td",{class:"angle","data-angle":e.output});this.angles.push({reading:t,angle:n});let s=e.shown!==null,r=s?qs(e.shown,this.say):M("span",{class:"quiet"},"not determined"),o=s&&e.decimal!==e.shown&&M("div",{class:"quiet decimal"},Fn(e.decimal));return[n,M("td",{class:"number"},r,o)]}#a(t){let[e,n]=t.map(r=>r?.shown??null),s=this.one?uu(e,n):null;return s?s.gap==="0"?M("td",{class:"number quiet"},"none"):M("td",{class:"number","data-gap":s.gap},qs(s.gap,this.say),M("div",{class:"quiet"},du(s.part))):M("td",{class:"quiet"},"–")}#l(){let t=this.search.value.trim().toLowerCase();for(let{name:e,row:n}of this.rows)n.hidden=!e.toLowerCase().includes(t);for(let e of this.node.querySelectorAll(".faces"))e.hidden=!!t;t&&this.others&&(this.others.open=!0)}mark(t){let e=this.rows.find(({pick:n})=>n.getAttribute("aria-pressed")==="true")?.pick;for(let n of this.rows)n.row.classList.toggle("chosen",n.name===t),n.pick.setAttribute("aria-pressed",String(n.name===t));return e}set(t){if(this.node.offsetParent){for(let e of this.dials)e.set();if(t)for(let{reading:e,angle:n}of this.angles)n.textContent=zs(e.now);this.sky&&this.sky.set(t)}}};var cS=/^[A-Za-z_][A-Za-z0-9_-]*$/,hS=new Set(["null","true","false","yes","no","on","off","y","n"]),uS="All tooth counts are as declared. They can be changed under Wheels: all speeds are then recomputed exactly, and the changes are listed here.",to=i=>cS.test(i)&&!hS.has(i.toLowerCase())?i:JSON.stringify(i);function dS(i){let{scene:t,steps:e}=i,{parent:n}=t.formulas,s=new Map;for(let{wheel:r,link:o,count:a}of e)s.set(o,[...s.get(o)??[],`${to(r)}: {teeth: ${a}}`]);return[`name: ${to(`${t.name}-changed`)}`,`title: ${JSON.stringify(`${t.title||t.name}, with other counts`)}`,`extends: ${to(n).startsWith('"')&&!/[:#{}[\],&*?|<>=!%@\\"' ]/.test(n)?n:to(n)}`,"links:",...[...s].map(([r,o])=>`  ${to(r)}: {wheels: {${o.join(", ")}}}`),""].join(`
`)}var om=i=>i?"further apart":"closer together";function fu({pair:i,off:t,apart:e,module:n}){if(t===null&&e===null)return`${i.id}: its axes intersect, so its wheels must be redesigned and repositioned`;if(t===null&&!e)return"";if(t===null)return`${i.id}: needs axes ${Math.abs(e).toPrecision(3)} mm ${om(e>0)} (as drawn)`;if(t.numerator===0n)return"";let s=t.numerator<0n?nt.of(0).minus(t):t,r=`${s} ${s.equals(1)?"module":s.denominator===1n?"modules":"of a module"}`;return`${i.id}: needs axes ${r} ${om(t.numerator>0n)} (${(Number(s)*n).toPrecision(3)} mm as drawn)`}var Ul=class{constructor(t,{onCounts:e,say:n}){Object.assign(this,{onCounts:e,say:n});let s=t.filter(({steps:r})=>r.length);this.node=M("div",{},s.length?s.map(r=>this.#t(r,t.length>1)):M("p",{class:"quiet"},uS))}#t(t,e){let n=M("button",{type:"button",class:"small",onclick:()=>this.onCounts(t,t.formulas.declared),"data-key":"reset"},"All as declared"),s=t.meshes.map(fu).filter(Boolean);return M("section",{class:"change","aria-label":"changes"},M("div",{class:"row"},M("h3",{},e?`${t.label}, changed`:"Changed"),n),M("ul",{class:"counts"},t.steps.map(({wheel:r,declared:o,count:a})=>M("li",{"data-changed":r},`${r}: ${o} → ${a} teeth`))),M("h4",{},"Meshes"),s.length?M("ul",{class:"misfits"},s.map(r=>M("li",{class:"bad"},r))):M("p",{},"All meshes still fit their axes."),t.declared.movement.kind==="real"&&M("p",{class:"quiet"},lu),M("h4",{},"Outputs"),this.#e(t),this.#n(t))}#e({scene:t,declared:e}){let n=t.pointers.flatMap((r,o)=>{let a=e.pointers[o].shown;if(a===r.shown)return[];let l=uu(a,r.shown),c=[a,r.shown].map(h=>M("td",{class:"number"},h===null?"not determined":Fn(h)));return[M("tr",{"data-turned":r.output},M("th",{scope:"row"},r.output),c,M("td",{},l?du(l.part):""))]});return n.length?M("div",{class:"scroll",tabindex:0,role:"region","aria-label":"changed outputs"},M("table",{},M("thead",{},M("tr",{},["output","declared","now","change"].map(r=>M("th",{scope:"col"},r)))),M("tbody",{},n))):M("p",{},"No output speed has changed.")}#n(t){let e=dS(t),n=`${t.scene.name}-changed.yaml`.replace(/[^\w.-]+/g,"-"),s=()=>{let o=URL.createObjectURL(new Blob([e],{type:"application/yaml"}));M("a",{href:o,download:n}).click(),setTimeout(()=>URL.revokeObjectURL(o),1e3),this.say(`${n} saved`)},r=async()=>this.say(await Kr(e)?"declaration copied":"the browser does not permit copying");return[M("h4",{},"Declaration"),M("pre",{class:"yaml",tabindex:0},e),M("div",{class:"buttons"},M("button",{type:"button",onclick:s,"data-key":"save"},"Save YAML"),M("button",{type:"button",onclick:r,"data-key":"copy"},"Copy"))]}};function pu(i,t,e,n,s=!1){let r=i.formulas?.at(t)??null;if(r===null)return null;let{id:o}=i.scene.wheels[t],a=i.counts[r],l=u=>e(i,i.counts.map((d,f)=>f===r?u:d)),c=(u,d,f)=>M("button",{type:"button",class:"step","aria-label":`one tooth ${f} on ${o}`,"data-key":`${n} ${i.index} ${o} ${u}`,disabled:a+u<1n,onclick:()=>l(a+u)},d),h=s&&M("input",{type:"text",inputmode:"numeric",maxlength:13,value:a,"aria-label":`teeth of ${o}`,"data-key":`${n} ${i.index} ${o}`,onchange:u=>{let d=tm(u.target.value);d===null?u.target.value=a:d!==a&&l(d)}});return M("span",{class:"stepper"},c(-1n,"−","less"),h,c(1n,"+","more"))}function am(i,t){let e=i.pairs.filter(n=>(t.pairs??[]).includes(n.id));return{pairs:e.map(n=>n.id),wheels:[...new Set(e.flatMap(n=>n.wheels))],bodies:e.length?[]:i.bodies.flatMap((n,s)=>(t.links??[]).includes(n.id)?[s]:[])}}function fS({scene:i},t){return i.elements?.length?M("ul",{class:"elements","aria-label":"brakes and clutches"},i.elements.map(e=>M("li",{},M("button",{type:"button",class:e.closed?"element closed":"element",title:e.text,"aria-label":`${e.text}, ${e.closed?"closed":"open"}`,onclick:()=>t(e)},e.one_way?`${e.id} ↻`:e.id)))):null}function lm(i,t,e,n){let{kind:s,text:r,loops:o=[]}=i.scene.verdict,a=s!=="determined";return M("div",{class:a?"verdict bad":"verdict","data-verdict":s},a&&M("p",{},t&&M("span",{},`${i.label}: `),M("strong",{},s),r&&r!==s&&` ${r}`),o.length?M("ul",{class:"loops"},o.map(l=>M("li",{},M("button",{type:"button",class:"loop",onclick:()=>e(i,l)},l.text||(l.pairs??l.links??[]).join(", "))))):null,fS(i,l=>n(i,l)))}var Fl=class{constructor(t,{compare:e,theme:n,onKeys:s,onShow:r,onLoop:o,onElement:a,onChanged:l}){this.all=t,this.onShow=r,this.onLoop=o,this.onElement=a,this.onChanged=l,this.title=M("h1",{}),this.names=M("p",{class:"quiet names"}),this.verdicts=M("div",{class:"verdicts"}),this.first=this.#t(0,!1),this.second=this.#t(e&&t.length>1?1:"",!0);let c=t.length>1,u=t.some(({machine:f})=>f.run)?"Motion":t.some(f=>f.scene.state)&&!e?"State":"Train",d=c&&ke("Beside",this.second);this.choices=M("div",{class:"choices"},c&&ke(u,this.first),e&&d),this.node=M("header",{class:"head"},M("div",{},this.title,this.names,this.verdicts),this.choices),this.rest=[c&&!e&&d,ke("Theme",n),M("button",{type:"button",class:"for-keys",onclick:s,"aria-haspopup":"dialog"},"Keys")].filter(Boolean),this.write()}#t(t,e){let n=M("select",{onchange:()=>this.#e()},e&&M("option",{value:""},"nothing"),this.all.map((s,r)=>M("option",{value:r},s.label)));return n.value=String(t),n}#e(){this.write(),this.onShow(this.sides)}get sides(){let t=[this.first.value,this.second.value].filter(e=>e!=="").map(Number);return[...new Set(t)].map(e=>this.all[e])}#n(t){let e=t.meshes.filter(fu).length,n=t.steps.map(({wheel:o,declared:a,count:l})=>`${o} ${a} → ${l}`),s=e?`${e} ${e===1?"mesh no longer fits its axes":"meshes no longer fit their axes"}`:"all meshes still fit their axes",r=M("button",{type:"button",class:"plain",onclick:()=>this.onChanged()},n.slice(0,6).join(", ")+(n.length>6?", ...":""));return M("span",{class:"changed"}," changed: ",r,`; ${s}`)}write(){let{sides:t}=this,e=t.length>1,n=[...new Set(t.map(({scene:r})=>r.title||r.name))];this.title.textContent=n.join(" and ");let s=[...new Set(t.map(({scene:r})=>r.name))];this.names.replaceChildren(s.length>1?s.join(", "):Tl(t[0].scene),...t.filter(({steps:r})=>r.length).slice(0,1).map(r=>this.#n(r))),this.verdicts.replaceChildren(...t.map(r=>lm(r,e,(o,a)=>this.onLoop(o,am(o.scene,a)),this.onElement)))}};var pS=[["Left, Right","turn back or forward by five degrees; with Shift by one unit of the input"],["Page Up, Page Down","one unit of the input forward or back"],["G","go to a number of turns"],["B","play backwards, or forwards again"]],mS=[["Home","back to the start"],["Space","play or pause"],["/","find a wheel"],["1, 2, 3, 4","view from the front, the back, the side, or freely"],["C","next colours"],["E","take apart, put together"],["H","hide or show the front"],["N","names of the parts on or off"],["T","teeth on or off"],["?","this list"],["Escape","close, or clear the selection"]],gS=[["Left, Right","step by 1/25 s of playback; with Shift to the previous or next impact"],["Page Up, Page Down","to the next or previous impact"],["G","go to the time slider"]],mu="Drag the crank, or the handle in the picture. Drag elsewhere in the picture to rotate the view, pinch or scroll to zoom, click a wheel for details.",cm="input:not([type=checkbox]):not([type=range]), textarea, select",hm={1:"front",2:"back",3:"side",4:"free"},Bl=class{constructor(t){this.actions=t,this.letters=M("input",{type:"checkbox"}),this.letters.checked=!0;let e=M("button",{type:"button",onclick:()=>this.dialog.close()},"Close");this.dialog=M("dialog",{"aria-labelledby":"keys-title"},M("h2",{id:"keys-title"},"Keys"),M("dl",{class:"keys"},[...t.timed?gS:pS,...mS].map(([n,s])=>[M("dt",{},M("kbd",{},n)),M("dd",{},s)])),M("p",{},mu),M("label",{class:"field tick"},M("span",{},"Single-letter shortcuts"),this.letters),e),this.node=this.dialog,document.addEventListener("keydown",n=>this.#t(n))}open(){this.dialog.showModal()}#t(t){if(t.ctrlKey||t.metaKey||t.altKey||t.defaultPrevented||this.dialog.open)return;let e=t.target instanceof Element?t.target:document.body;if(t.key==="Escape"){e.matches(cm)&&e.blur(),this.actions.escape();return}if(e.closest(cm))return;(this.#e(t,e)||this.letters.checked&&this.#n(t.key))&&t.preventDefault()}#e({key:t,shiftKey:e},n){let{drive:s}=this.actions;if(t===" "&&!n.closest("button, a, input, summary"))return s.play(),!0;if(n.closest("[role=tablist], input, .scroll")||n.closest(".pages")&&t.startsWith("Page"))return!1;let r={ArrowRight:1,ArrowUp:1,ArrowLeft:-1,ArrowDown:-1}[t];return r&&!((t==="ArrowUp"||t==="ArrowDown")&&!n.closest(".handle, canvas"))?(e?s.unit(r):s.nudge(r),!0):t==="PageUp"||t==="PageDown"?(s.unit(t==="PageUp"?1:-1),!0):t==="Home"?(s.goTo(nt.of(0)),!0):!1}#n(t){let{tools:e,goTo:n,find:s,back:r}=this.actions;if(hm[t])return e.look(hm[t]),!0;let o={g:n,"/":s,b:r,c:()=>e.next(),e:()=>e.takeApart(),h:()=>e.toggle(e.front),n:()=>e.toggle(e.names),t:()=>e.toggle(e.teeth),"?":()=>this.open()}[t.toLowerCase()];return o?.(),!!o}};var _S=8,kl=class{constructor(){this.node=M("div",{class:"unseen",role:"status","aria-live":"polite","aria-atomic":"true"}),this.readings=[]}use(t){this.readings=t.flatMap(e=>{let n=e.scene.pointers.map((r,o)=>new sn(e.scene,e.machine,o)),s=n.filter(r=>r.dial);return(s.length?s:n).slice(0,_S).map(r=>({reading:r,label:t.length>1?`${e.label} `:""}))})}say(t){clearTimeout(this.waiting),this.node.textContent=t}rest(t){clearTimeout(this.waiting),this.waiting=setTimeout(()=>{if(t.playing)return;let e=this.readings.map(({reading:n,label:s})=>`${s}${n.pointer.output} ${zs(n.now)}`);this.node.textContent=[t.run?`${t.time.toPrecision(4)} seconds`:`${Yr(t.at)} turns`,...e].join("; ")},500)}};function xS(i){return M("li",{},M("strong",{},i.what),i.why&&`: ${i.why}`,i.fix&&M("span",{class:"quiet"},` ${i.fix}`),i.place&&M("span",{class:"quiet"},` (${i.place})`))}function vS([i,t]){let{cite:e,url:n,...s}=t;return M("li",{id:`source-${i}`},M("strong",{},i),e&&` ${e}`,n&&[" ",yl(n)],Object.values(s).map(r=>M("span",{class:"quiet"},` ${r}`)))}function yS(i){if(i.run&&!i.touching)return M("p",{},"All angles are those of a simulation with inertia, backlash and friction, to 0.006 degrees.");let{kind:t,why:e}=i.movement;return M("p",{},{exact:"All angles are exact: rational multiples of the turns of the crank.",real:"Mean speeds are exact; the deviations caused by teeth and pins were computed in advance.",mean:"Only mean motion is shown; the motion of teeth and pins could not be computed.",still:"The train does not move."}[t]??"",e&&` ${e}`)}function um(i,t){let{scene:e}=i,n=Object.entries(e.sources);return M("article",{},M("h3",{},t?i.label:e.name),M("p",{},`${e.verdict.kind}: ${e.verdict.text}`),e.note&&M("p",{},e.note),M("p",{class:"quiet"},`${[[e.wheels,"wheel"],[e.pairs,"gear pair"],[e.couplings,"pin"]].filter(([{length:s}])=>s).map(([{length:s},r])=>`${s} ${r}${s===1?"":"s"}`).join(", ")}.`,e.unit&&` Speeds in ${e.unit}.`),yS(e),e.notices.length?[M("h4",{},"Simplifications of the picture"),M("ul",{class:"notices"},e.notices.map(xS))]:null,M("h4",{},"Sources"),n.length?M("ul",{class:"sources"},n.map(vS)):M("p",{class:"quiet"},"No sources are given."))}var MS=6,bS=1/3,SS=12,dm=84,wS=4,fm=.5,zl=class{constructor(t){this.run=t,this.onSeek=()=>{},this.pace=1;let e=Math.min(16,Math.max(4,110/Math.max(1,t.contacts.length)));Object.assign(this,{lane:e,named:e>=SS,height:Math.ceil(e*t.contacts.length)}),this.node=M("canvas",{class:"strip",role:"img","aria-label":"contacts near this moment; the table under Contacts lists them",style:`height: ${this.height}px`}),this.node.addEventListener("pointerdown",n=>this.#s(n)),this.width=0,new ResizeObserver(()=>{this.width=this.node.clientWidth,this.#r()}).observe(this.node)}set(t){this.time=t,this.#r()}get#t(){return this.named?dm:0}get#e(){return Math.min(MS*this.pace,this.run.duration)}get#n(){return Math.min(Math.max(0,this.time-(1-bS)*this.#e),this.run.duration-this.#e)}#s(t){let[e,n]=[t.clientX,this.time],s=this.#e/(this.width-this.#t),r=!1,o=l=>{r||=Math.abs(l.clientX-e)>wS,r&&this.onSeek(n-(l.clientX-e)*s,!1)},a=()=>{this.node.removeEventListener("pointermove",o);let l=e-this.node.getBoundingClientRect().left-this.#t;r?this.onSeek(this.time,!0):l>=0&&this.onSeek(this.#n+l*s,!0)};this.node.setPointerCapture(t.pointerId),this.node.addEventListener("pointermove",o),this.node.addEventListener("lostpointercapture",a,{once:!0})}#r(){let{width:t}=this;if(!t||this.time===void 0)return;let e=Math.min(globalThis.devicePixelRatio||1,2),[n,s]=[Math.round(t*e),Math.round(this.height*e)];(this.node.width!==n||this.node.height!==s)&&Object.assign(this.node,{width:n,height:s});let r=this.node.getContext("2d"),o=this.#i();r.setTransform(e,0,0,e,0,0),r.clearRect(0,0,t,this.height),r.font="11px system-ui, sans-serif",r.textBaseline="middle";let[a,l,c]=[this.#n,this.#e,this.#t],h=u=>c+(u-a)/l*(t-c);this.run.contacts.forEach((u,d)=>this.#o(r,u,d,o,h,a,t)),r.fillStyle=o.ink,r.fillRect(h(this.time)-.75,0,1.5,this.height)}#i(){let{theme:t}=document.documentElement.dataset;if(!this.colours||this.theme!==t){let e=getComputedStyle(this.node),n=s=>e.getPropertyValue(`--${s}`).trim();this.colours={line:n("line"),ink:n("ink"),a:n("apart"),c:n("coast"),blow:n("blow")},this.theme=t}return this.colours}#o(t,e,n,s,r,o,a){let[l,c,h]=[n*this.lane,this.lane-1,o+this.#e];t.fillStyle=s.line,t.fillRect(this.#t,l+c,a,1),this.named&&(t.fillStyle=s.ink,t.fillText(e.name,0,l+c/2,dm-8));let u=-1/0;for(let[m,x,p]of this.run.stretches(n,o,h)){let[g,S]=[Math.max(r(x),this.#t),r(p)];m==="d"||S<u+fm||(t.fillStyle=s[m],t.fillRect(g,l+.15*c,Math.max(.7,S-g),.7*c),u=Math.max(S,g+.7))}let[d,f]=[-1/0,0];t.fillStyle=s.blow;for(let[m,x]of this.run.blowsOf(n,o,h)){let p=r(m);p<d+fm&&x<=f||(t.fillRect(p-.75,l+c*(1-x),1.5,c*x),[d,f]=[p,x])}}};var TS=10,[ES,AS]=[-3,1];function pm(i,t){let e=Math.min(6,Math.max(0,4-Math.ceil(Math.log10(Math.max(t,.001)))));return`${i.toFixed(e)} s`}function gu(i){let t=Math.max(0,...i.contacts.map(({impact_rate:e})=>e));return Math.min(1,Math.max(.02,TS/Math.max(t,1e-9)))}var Gl=class{constructor(t,e){Object.assign(this,{drive:e,run:t.machine.run});let{run:n}=this;this.time=M("output",{class:"turns","aria-live":"off"}),this.playing=M("button",{type:"button",class:"round",onclick:()=>e.play()}),this.slider=M("input",{type:"range",class:"moment",min:0,max:n.duration,step:"any","aria-label":"time",oninput:()=>e.goToTime(Number(this.slider.value),!1),onchange:()=>e.goToTime(Number(this.slider.value))}),this.loop=M("input",{type:"checkbox",onchange:()=>e.loop=this.loop.checked}),this.loop.checked=e.loop,this.strip=new zl(n),this.strip.onSeek=(r,o)=>e.goToTime(r,o);let s=(r,o,a)=>M("button",{type:"button",onclick:()=>e.unit(r),"aria-label":o,title:o},mn(a));this.node=M("section",{class:"crank playhead","aria-label":"time"},M("div",{class:"buttons"},s(-1,"previous impact","M6 5v14M19 5l-9 7 9 7z"),this.playing,s(1,"next impact","M18 5v14M5 5l9 7-9 7z")),M("div",{class:"where"},this.time,M("span",{class:"quiet"},`of ${pm(n.duration,n.duration)}; ${_u(t.scene.run.rate)} of ${t.lead}`)),this.#t(gu(n)),ke("Repeat",this.loop,{class:"field tick"}),this.slider,this.strip.node)}#t(t){let e=M("span",{class:"pace"}),n=M("input",{type:"range",min:ES,max:AS,step:.05,value:Math.log10(t)}),s=()=>{let r=Math.abs(n.value)<.03?1:10**Number(n.value);this.drive.rate=r/this.run.period,this.run.pace=r,this.strip.pace=r;let o=Number(r.toPrecision(2));e.textContent=r===1?"real time":`${o} × real time`,n.setAttribute("aria-valuetext",r===1?"real time":`${o} × real time`),this.drive.goTo(this.drive.at,!this.drive.playing)};return n.addEventListener("input",s),s(),ke("Speed",M("span",{class:"with"},n,e),{class:"field speed"})}find(){this.slider.focus()}set(t,e){let n=Math.min(this.run.duration,Math.max(0,Number(t.at)*this.run.period)),s=pm(n,this.run.duration);this.time.textContent=s,this.slider.value=String(n),(e||!t.playing)&&this.slider.setAttribute("aria-valuetext",s),this.strip.set(n),this.shown!==t.playing&&(this.shown=t.playing,this.playing.replaceChildren(mn(t.playing?Jr:Ws)),this.playing.setAttribute("aria-label",t.playing?"pause":"play"))}};function _u(i){let t=Math.abs(i)/(2*Math.PI),[e,n]=t<.001?[3600,"h"]:[1,"s"],s=Number((t*e).toPrecision(4));return`${s} ${s===1?"turn":"turns"}/${n}`}var CS={d:"drive flank",c:"coast flank",a:"separated","":"–"},mm={pair:"",pin:"pin",escapement:"escapement"},xu=2e-4,RS=i=>i?`${Number((100*i).toFixed(i<.01?3:i<.1?2:1))} %`:"0",Hl=i=>String(Number(i.toPrecision(3))).replace("-","−"),Vl=i=>`${Hl(i*180/Math.PI)}°`,Wl=class{constructor(t,e){this.onChoose=e,this.rows=[],this.leads=[];let n=t.filter(({machine:s})=>s.simulated);this.node=M("div",{},n.map(s=>this.#t(s,t.length>1)),n.length?null:M("p",{class:"quiet"},"In this motion all drive flanks are in contact, as without inertia."))}#t(t,e){let{run:n}=t.scene;return M("section",{},e&&M("h3",{},t.label),M("ul",{class:"legend tells"},vu("blow","impact"),vu("apart","teeth separated"),vu("coast","contact on the coast flank")),n.contacts.length?M("div",{class:"scroll",tabindex:0,role:"region","aria-label":"contacts"},this.#e(t)):M("p",{class:"quiet"},"No pair has real teeth, a pin or a loss, so there are no separations or impacts."),this.#n(t),M("p",{},PS(n)),n.complete?null:M("p",{class:"bad"},"The simulation was stopped before its end."),n.notes.map(s=>M("p",{class:"note"},s)))}#e(t){let{scene:e,machine:n}=t,s=["contact","now","separated","coast","impacts/s","maximum"],r=e.run.contacts.map((o,a)=>{let l=M("td",{class:"now"});this.rows.push({now:l,state:()=>n.run.state(a,n.time())});let c=[o.apart,o.coast].map(h=>M("td",{class:"number"},RS(h)));return M("tr",{"data-contact":o.name},M("th",{scope:"row"},M("button",{type:"button",class:"plain",onclick:()=>this.onChoose(t,a)},o.name),mm[o.kind]&&M("div",{class:"quiet"},mm[o.kind])),l,c,M("td",{class:"number"},Hl(o.impact_rate)),M("td",{class:"number"},o.hardest?`${Vl(o.hardest)}/s`:"–"))});return M("table",{class:"outputs contacts"},M("caption",{class:"unseen"},"Contacts: present state, and shares of the whole run"),M("thead",{},M("tr",{},s.map(o=>M("th",{scope:"col"},o)))),M("tbody",{},r))}#n({scene:t,machine:e}){if(!t.run.deviations.length)return null;if(!t.run.deviations.some(({ahead:s,behind:r})=>eo(s,xu)||eo(r,xu)))return M("p",{},"No output deviates from the motion with all drive flanks in contact.");let n=t.run.deviations.map(s=>{let r=t.pointers.findIndex(({output:a})=>a===s.output),o=M("td",{class:"number"});return r<0||t.movement.kind==="mean"?o.textContent="–":this.leads.push({now:o,ahead:()=>e.aheadBy(r)}),M("tr",{"data-lead":s.output},M("th",{scope:"row"},s.output),o,M("td",{class:"number"},Vl(eo(s.ahead))),M("td",{class:"number"},Vl(eo(s.behind))))});return M("div",{class:"scroll"},M("p",{},"Outputs relative to the motion with all drive flanks in contact:"),M("table",{class:"outputs"},M("thead",{},M("tr",{},["output","ahead now","maximum ahead","maximum behind"].map(s=>M("th",{scope:"col"},s)))),M("tbody",{},n)))}set(t){if(!(!t||!this.node.offsetParent)){for(let{now:e,state:n}of this.rows){let s=n();e.textContent=CS[s],e.dataset.state=s}for(let{now:e,ahead:n}of this.leads)e.textContent=Vl(eo(n(),xu))}}},eo=(i,t=1e-7)=>Math.abs(i)<t?0:i,vu=(i,t)=>M("li",{},M("span",{class:`swatch ${i}`}),t);function PS({driven:i,link:t,torque:e,rate:n,skip:s}){let r={rate:"kept at constant speed",torque:"driven by a torque or a weight",spring:"driven by a spring",hand:"driven by a hand of finite stiffness"}[i],o=s?` The first ${Hl(s)} s are omitted.`:"";return`${t} is ${r}: mean speed of the input ${_u(n)}, torque ${Hl(1e3*e)} N mm.${o}`}function IS(i,t){return t.pairs.map(e=>{let n=i.pairs.find(r=>r.id===e);if(n){let r=n.wheels.map(o=>i.wheels[o]);return{id:e,words:r.map(o=>`${o.id} (${o.teeth})`).join(" with "),text:n.text,wheel:n.wheels[0]}}let s=i.couplings.find(r=>r.id===e);return{id:e,words:s?s.kind.replaceAll("_"," "):e,text:s?.text??"",wheel:null}})}var Xl=class{constructor({onPair:t,onClose:e}){this.onPair=t,this.onClose=e,this.node=M("section",{class:"path",hidden:!0,"aria-label":"path"})}show(t,e){let n=M("button",{type:"button",class:"small",onclick:()=>this.onClose()},"Clear path"),s=M("div",{class:"row"},M("h3",{},`${LS(e[0])} to ${t}`),n);this.node.replaceChildren(s,...e.flatMap(r=>this.#t(r,e.length>1))),this.node.hidden=!1}#t({side:t,pointer:e},n){let s=IS(t.scene,e),r=t.scene.bodies[e.base],o=[e.text,r?.parent!=null&&`relative to ${r.id}`,e.note].filter(Boolean).join("; ");return[M("p",{class:"quiet"},n&&`${t.label}: `,o),s.length?M("ol",{class:"steps","data-side":t.label},s.map(a=>this.#e(t,a))):M("p",{class:"quiet"},"There are no pairs on the path.")]}#e(t,{id:e,words:n,text:s,wheel:r}){let a=r===null?n:M("button",{type:"button",class:"plain",onclick:()=>this.onPair(t,r)},n);return M("li",{"data-pair":e,title:s},a)}hide(){this.node.hidden=!0,this.node.replaceChildren()}},LS=({side:{scene:i}})=>`From ${i.driving_link===null?"the input":i.bodies[i.driving_link].id}`;var ql=class{constructor(t,e){this.panels=t.map(s=>{let[r,o]=[tu("tab"),tu("page")];return{...s,tab:M("button",{type:"button",role:"tab",id:r,"aria-controls":o,onclick:()=>this.show(s.name)},s.name),page:M("div",{role:"tabpanel",id:o,tabindex:0,"aria-labelledby":r,class:"page","data-page":s.name},s.node)}});let n=M("div",{role:"tablist","aria-label":e},this.panels.map(s=>s.tab));n.addEventListener("keydown",s=>this.#t(s)),this.list=n,this.node=M("div",{class:"tabs"},n,M("div",{class:"pages"},this.panels.map(s=>s.page))),this.show(t[0].name)}#t(t){let e={ArrowRight:1,ArrowDown:1,ArrowLeft:-1,ArrowUp:-1}[t.key],n=this.panels.findIndex(o=>o.name===this.current),s=this.panels.length-1,r=e?(n+e+s+1)%(s+1):{Home:0,End:s}[t.key];r!==void 0&&(t.preventDefault(),t.stopPropagation(),this.show(this.panels[r].name),this.panels[r].tab.focus())}show(t){this.current=t;for(let e of this.panels){let n=e.name===t;e.tab.setAttribute("aria-selected",String(n)),e.tab.tabIndex=n?0:-1,e.page.hidden=!n}this.onShow?.(t)}};var DS={surviving:"surviving",reconstructed:"reconstructed",hypothetical:"hypothetical"},NS=i=>`${(i*100).toPrecision(3)} % of the input power`;function OS(i,t,e,n=null){let s=i.bodies[t.body],r=i.sources[t.source],o=i.pairs.filter(l=>t.circuits.includes(l.id)),a=s.shown===null?[["Speed","not determined"]]:[["Speed, exact",qs(s.shown,e)],["Speed, decimal",`${Fn(s.decimal)}${i.unit&&!s.travels?` ${i.unit}`:""}`]];return[["Teeth",n??qs(String(t.teeth),e)],["Uncertain",t.doubt],["Kind",t.kind],["On",`${s.id}${s.role==="arbor"?"":` (${s.role})`}`],["Status",DS[t.status]??"not stated"],...a,["",s.bookkeeping?"sum over joints that are not parallel, not a rotation":""],["Circuits",o.length?M("ul",{},o.map(l=>M("li",{class:l.broken&&"bad"},`${l.id}, carried by ${i.bodies[l.carrier]?.id??"nothing"}: ${l.text}`))):"no meshes"],["Loss",t.loss===null||t.loss===void 0?"":NS(t.loss)],["Note",t.note],["Source",t.source&&M("span",{},`${t.source}${r?.cite?`: ${r.cite}`:""} `,r?.url&&yl(r.url))]].filter(([,l])=>l!==""&&l!==null&&l!==void 0)}var $l=class{constructor(t,{onSelect:e,onCounts:n,say:s}){this.sides=t,this.onCounts=n,this.onSelect=e,this.say=s,this.items=[],this.detail=M("section",{class:"detail",hidden:!0,"aria-label":"wheel",tabindex:-1}),this.search=M("input",{type:"search",placeholder:"Find a wheel","aria-label":"find a wheel",oninput:()=>this.#e()}),this.none=M("p",{class:"quiet",hidden:!0},"No wheel has this name."),this.node=M("div",{},this.detail,this.search,this.none,t.map(r=>this.#t(r)))}#t(t){let e=t.scene.wheels.map((n,s)=>{let r=M("button",{type:"button","aria-pressed":"false","data-wheel":n.id,onclick:()=>this.onSelect(t,s)},M("span",{},n.id),M("span",{class:"quiet"},`${n.teeth}${n.doubt?" ?":""}`)),o=pu(t,s,this.onCounts,"list"),a=M("li",{class:t.steps.some(c=>c.wheel===n.id)&&"stepped"},r,o),l=`${n.id} ${n.teeth} ${t.scene.bodies[n.body].id} ${n.status}`.toLowerCase();return this.items.push({side:t,index:s,item:a,button:r,text:l}),a});return[this.sides.length>1&&M("h3",{},t.label),M("ul",{class:t.formulas?"wheels stepped":"wheels"},e)]}#e(){let t=this.search.value.trim().toLowerCase();for(let e of this.items)e.item.hidden=!e.text.includes(t);this.none.hidden=this.items.some(e=>!e.item.hidden)}show(t,e){for(let r of this.items)r.button.setAttribute("aria-pressed",String(r.side===t&&r.index===e));let n=this.detail.contains(document.activeElement);if(this.detail.hidden=e===null,n&&e===null&&this.before?.focus(),this.before=this.items.find(r=>r.side===t&&r.index===e)?.button,this.detail.replaceChildren(),e===null)return;let s=t.scene.wheels[e];this.detail.append(M("div",{class:"row"},M("h3",{},`Wheel ${s.id}`),M("button",{type:"button",class:"small",onclick:()=>this.onSelect(t,null)},"Close")),M("dl",{},OS(t.scene,s,this.say,pu(t,e,this.onCounts,"one",!0)).map(([r,o])=>[M("dt",{},r),M("dd",{},o)])))}};var Yl=class{constructor(t){this.owner=t;let n=["Readings","Wheels",t.all.some(({formulas:s})=>s)&&"Change","About"].filter(Boolean);t.all.some(({machine:s})=>s.run)&&n.unshift("Contacts"),this.places=Object.fromEntries(n.map(s=>[s,M("div",{})])),this.way=new Xl({onPair:(s,r)=>t.select(s,r),onClose:()=>t.letGo()}),this.tabs=new ql(Object.entries(this.places).map(([s,r])=>({name:s,node:r})),"panels"),this.tabs.onShow=()=>this.open(!0),addEventListener("beforeprint",()=>this.#t(!0)),matchMedia("print").addEventListener("change",({matches:s})=>this.#t(s)),this.grip=M("button",{type:"button",class:"grip","aria-expanded":"false","aria-controls":"panel",onclick:()=>this.open(!this.node.classList.contains("open"))},"Open panels"),this.node=M("aside",{class:"panel",id:"panel",tabindex:-1,"aria-label":"panels"},this.grip,this.way.node,this.tabs.node)}open(t){let e=t&&this.grip.offsetParent&&!this.node.classList.contains("open");this.node.classList.toggle("open",t),e&&document.querySelector(".views")?.scrollIntoView(),this.grip.setAttribute("aria-expanded",String(t)),this.grip.textContent=t?"Close panels":"Open panels",t&&this.readings&&this.set(!0)}use(t){let e=l=>this.owner.live.say(l),n=l=>this.owner.choose(l),s=l=>this.owner.setTo(l),r=this.readings?.comparison?.open;this.readings=new Ol(t,{onChoose:n,onSet:s,say:e}),r&&this.readings.comparison&&(this.readings.comparison.open=!0);let o=(l,c)=>this.owner.count(l,c);this.wheels=new $l(t,{onSelect:(l,c)=>this.owner.select(l,c),onCounts:o,say:e}),this.change=new Ul(t,{onCounts:o,say:e}),this.chosen=null,this.contacts=new Wl(t,(l,c)=>this.owner.contact(l,c)),this.places.Contacts?.replaceChildren(this.contacts.node),this.places.Readings.replaceChildren(this.readings.node),this.places.Wheels.replaceChildren(this.wheels.node),this.places.Change?.replaceChildren(this.change.node);let a=M("p",{class:"quiet for-fingers"},mu);this.places.About.replaceChildren(a,...t.map(l=>um(l,t.length>1)))}set(t){this.readings.set(t),this.contacts.set(t)}#t(t){for(let e of this.owner.sides)e.print(t);if(t){for(let e of this.node.querySelectorAll(".more"))e.open=!0;this.set(!0)}}showChange(){this.tabs.show("Change")}wheel(t,e){this.wheels.show(t,e);let n=this.chosen?.[1]===e;this.chosen=e===null?null:[t,e],!n&&(e!==null&&this.tabs.show("Wheels"),e!==null&&this.wheels.detail.scrollIntoView({block:"nearest"}))}path(t,e){this.way.show(t,e),this.readings.mark(t),this.open(!0)}find(){this.tabs.show("Wheels"),this.wheels.search.focus(),this.wheels.search.select()}letGo(){let t=this.way.node.contains(document.activeElement);this.way.hide();let e=this.readings.mark(null);t&&e?.focus()}};function yu(i){let t=i.map(r=>r.canvas),e=document.createElement("canvas");e.width=t.reduce((r,{width:o})=>r+o,0),e.height=Math.max(...t.map(({height:r})=>r));let n=e.getContext("2d"),s=0;return i.forEach((r,o)=>{r.render(),n.drawImage(t[o],s,0),s+=t[o].width}),e}var gm=i=>new Promise(t=>yu(i).toBlob(t,"image/png")),US=["fill","fill-opacity","fill-rule","stroke","stroke-width","stroke-linejoin","vector-effect","opacity","display","text-anchor","font-family"];function _m(i){let[t,e]=[0,0],n=i.map(({canvas:o})=>{let a=o.cloneNode(!0),l=[o,...o.querySelectorAll("*")];[a,...a.querySelectorAll("*")].forEach((u,d)=>{let f=getComputedStyle(l[d]);for(let m of US)u.style.setProperty(m,f.getPropertyValue(m))});let{width:c,height:h}=o.getBoundingClientRect();for(let[u,d]of Object.entries({x:t,y:0,width:c,height:h}))a.setAttribute(u,d);return[t,e]=[t+c,Math.max(e,h)],a}),s=getComputedStyle(i[0].canvas.parentElement).backgroundColor,r=Vt("svg",{width:t,height:e},Vt("rect",{width:"100%",height:"100%",fill:s}),...n);return new Blob([new XMLSerializer().serializeToString(r)],{type:"image/svg+xml"})}var FS=.62,BS=12,[kS,zS]=[.24,.2],Zl=(i,t)=>i.findIndex(({id:e})=>e===t);function xm(i){return i.dials.length?GS(i):VS(i)}function GS(i){return i.pointers.flatMap(({output:t,body:e,dial:n,level:s},r)=>{if(n===null||qr(i,r)!==r)return[];let{look:o,centre:a,normal:l,zero:c,radius:h,scale:u}=i.dials[n],d=o==="ball",f=d?0:h*(u.turns>1?u.inner:FS*u.outer),m=H(a).addScaledVector(H(c),f).addScaledVector(H(l),d?0:s),x=g=>g.placed(m,d?g.poses.ball(n):e,H(a)),p=g=>d||g.clone().sub(H(a)).dot(H(l))>0;return[{name:t,order:Bs(i,r),at:x,faces:p}]})}function VS(i){let t=new Map;i.wheels.forEach(s=>{let r=t.get(s.body);(!r||Jn(s)>Jn(r))&&t.set(s.body,s)});let e=new Set([i.driving_link,...i.pointers.map(({body:s})=>s)]);return[...t.values()].sort((s,r)=>e.has(r.body)-e.has(s.body)||Jn(r)-Jn(s)).slice(0,BS).map(s=>{let{id:r,parent:o}=i.bodies[s.body],a=l=>{let c=H(s.direction).transformDirection(l.nodes[s.body].matrixWorld),h=s.kind==="ring",u=h?l.quarter.right.clone().negate():H([0,1,0]).addScaledVector(c,-c.y).normalize();return l.placed(H(s.centre),s.body).addScaledVector(u,h?(s.radius+Jn(s))/2:.9*s.radius)};return{name:o===null?s.id:r,order:null,at:a,faces:()=>!0}})}function vm(i,{kind:t,name:e}){let{scene:n}=i,s=t==="output"?n.pointers.find(({output:l})=>l===e):null,r=t==="dial"?Zl(n.dials,e):s?.dial??-1;if(r>=0)return HS(i,r);if(t==="wheel"){let l=n.wheels[Zl(n.wheels,e)];return{points:al(n,l).flatMap(On),towards:null,chosen:{wheels:[n.wheels.indexOf(l)]}}}let o=n.couplings[Zl(n.couplings,e)],a=t==="coupling"?o?[o.pin,o.slot]:[]:[s?.body??Zl(n.bodies,e)];return{points:WS(i,a),towards:null,chosen:{bodies:a}}}function HS(i,t){let{body:e,centre:n,normal:s,radius:r}=i.scene.dials[t],o=i.placed(H(n),e),a=H(s).addScaledVector(H([0,1,0]),kS).addScaledVector(H([Math.sign(s[2])||1,0,0]),zS);return{points:On({at:o,direction:s,radius:1.1*r}),towards:a.normalize(),chosen:null}}function WS(i,t){let e=({body:r})=>t.includes(r),n=Qi(i.scene).filter(e).flatMap(On);if(n.length)return n;let s=i.corners.filter(e).map(({point:r,body:o})=>i.placed(r,o));return s.length?s:i.outline()}var[Jl,Kl]=[10,19],$s=class{constructor(t){this.stage=t,this.node=Vt("svg",{class:"callouts","aria-hidden":"true"}),t.onDraw=()=>this.#e()}show(t){this.shown=t,this.node.toggleAttribute("hidden",!t),t&&this.stage.request()}#t(t){this.world=t,this.labels=xm(t.scene).map(e=>{let n=Vt("text",{},e.name),s=Vt("path",{}),r=Vt("g",{class:e.order===null?"":`hand-${e.order%nn.length}`},s,n);return{...e,text:n,way:s,group:r}}),this.node.replaceChildren(...this.labels.map(({group:e})=>e))}#e(){let{world:t,camera:e,width:n,height:s}=this.stage;if(!this.shown||!this.node.isConnected)return;this.world!==t&&this.#t(t);let r=this.labels.map(l=>{let c=l.faces(e.position)?l.at(t).project(e):null;return c&&Math.abs(c.x)<1&&Math.abs(c.y)<1?{label:l,x:(c.x+1)/2*n,y:(1-c.y)/2*s}:null});this.labels.forEach(({group:l},c)=>l.toggleAttribute("hidden",!r[c]));let o=r.filter(Boolean).sort((l,c)=>l.x-c.x),a=Math.ceil(o.length/2);this.#n(o.slice(0,a),!1),this.#n(o.slice(a),!0)}#n(t,e){let{width:n,height:s}=this.stage;t.sort((a,l)=>a.y-l.y);let r=Kl;for(let a of t)r=(a.place=Math.max(a.y,r))+Kl;let o=s-Kl/2;for(let a of t.toReversed())o=(a.place=Math.min(a.place,o))-Kl;for(let{label:a,x:l,y:c,place:h}of t){a.long||=a.text.getComputedTextLength();let[u,d]=e?[n-Jl,n-Jl-a.long-5]:[Jl,Jl+a.long+5];a.text.setAttribute("x",u),a.text.setAttribute("y",h.toFixed(1)),a.text.setAttribute("text-anchor",e?"end":"start"),a.way.setAttribute("d",`M${d.toFixed(1)} ${(h-4).toFixed(1)}L${l.toFixed(1)} ${c.toFixed(1)}`)}}};var XS="A plan is shown, because this browser has no 3D graphics (WebGL). Everything else works.",jl=class{constructor(t,e){this.app=t,this.index=e,this.scene=t.scenes[e],this.machine=t.machines[e],this.declared=this.scene,this.declaredMachine=this.machine,this.formulas=this.scene.formulas?new Il(this.scene):null,this.counts=this.formulas?.declared??[],this.stage=null,this.label=t.options?.compare?this.scene.name:this.scene.state??this.scene.name,this.machine.run&&(this.label=[this.scene.state,this.machine.simulated?"simulated":"drive flanks in contact"].filter(Boolean).join(", ")),this.legend=M("div",{}),this.place=M("div",{}),this.nothing=M("p",{class:"nothing",hidden:!0},XS);let n=M("figcaption",{},M("span",{class:"caption"},this.label),this.nothing,this.legend);this.figure=M("figure",{class:"view",hidden:!0},this.place,n)}open(){if(this.stage)return!1;this.stage=this.app.open(this.index);let{canvas:t}=this.stage;return this.nothing.hidden=t instanceof HTMLCanvasElement,this.callouts=this.stage.renderer?new $s(this.stage):null,this.place.replaceChildren(...[t,this.callouts?.node].filter(Boolean)),this.#t(t),!0}#t(t){t.setAttribute("tabindex","0"),t.setAttribute("role","img"),t.setAttribute("aria-label",`${this.label}, animated picture; the wheels are listed under Wheels`)}print(t){this.copy?.remove(),this.copy=t&&this.stage?.renderer?yu([this.stage]):null,this.copy?.classList.add("copy"),this.copy&&this.place.append(this.copy)}close(){this.stage&&(this.app.close(this.index),this.stage=null,this.place.replaceChildren())}change(t){this.counts=t;let{turns:e}=this.machine;this.scene=this.steps.length?this.formulas.changed(t):this.declared,this.day&&(this.scene=Rl(this.scene,this.day)),this.machine=this.scene===this.declared?this.declaredMachine:new _i(this.scene),this.machine.turns=e,this.app.scenes[this.index]=this.scene,this.app.machines[this.index]=this.machine}setTo(t){this.day=t,this.change(this.counts)}redraw(t){clearTimeout(this.drawing),this.drawing=setTimeout(()=>{this.stage&&(this.stage.rebuild(this.machine),t(this.stage))},150)}get steps(){if(!this.formulas)return[];let{given:t,declared:e}=this.formulas;return t.wheels.flatMap((n,s)=>{if(this.counts[s]===e[s])return[];let{body:r}=this.declared.wheels[t.count.indexOf(s)];return[{wheel:n,link:this.declared.bodies[r].id,declared:e[s],count:this.counts[s]}]})}get meshes(){return this.formulas.meshes(this.counts)}get movable(){return this.scene.movement.kind!=="still"&&this.scene.driving_link!==null}get#e(){let{step:t,unit:e,unit_days:n,run:s}=this.scene;if(s)return{name:"seconds of a run",size:nt.of(s.period)};let r=nt.parse(t);return!r||r.numerator===0n||!e?null:n?{name:"days",size:nt.of(n).over(r)}:{name:e,size:nt.of(1).over(r)}}gearing(t){let[e,n]=[this.#e,t.#e];return e&&n&&e.name===n.name?n.size.over(e.size):nt.of(1)}get lead(){return this.scene.driving_link===null?"the input":this.scene.bodies[this.scene.driving_link].id}beside(t){let e=this.gearing(t);return e.equals(1)&&this.lead===t.lead?"":`${Hs(e)} of ${this.lead} beside for each`}};var qS={system:"System",light:"Light",dark:"Dark"},Ys=class{constructor(t){this.onChange=t,this.system=matchMedia("(prefers-color-scheme: dark)"),this.system.addEventListener("change",()=>this.apply()),this.select=M("select",{"aria-label":"theme",onchange:()=>this.apply()},Object.entries(qS).map(([e,n])=>M("option",{value:e},n)))}apply(){let t=this.select.value,e=t==="dark"||t==="system"&&this.system.matches;document.documentElement.dataset.theme=e?"dark":"light",this.onChange(this.background)}get background(){return getComputedStyle(document.documentElement).getPropertyValue("--stage").trim()}};var bu={plain:"Brass",speed:"Speed",status:"Status",loss:"Loss"};function ym(i,t,e){let n=M("span",{class:i,"aria-hidden":"true"});return n.style.background=t,M("li",{},n,e)}var Mm=(i,t)=>ym("swatch",i,t),Mu=(i,t,e)=>ym("swatch ramp",`linear-gradient(90deg, ${i}, ${t})`,e);function $S(i){let t=["clockwise","counter-clockwise"],[e,n]=i.positive==="clockwise"?t:t.reverse(),s=r=>[Xr(r*1e-6,1),Xr(r,1)];return[Mu(...s(1),`${e}, slow to fast`),Mu(...s(-1),`${n}, slow to fast`),Mm(Xr(0,1),"at rest")]}function YS(i){let t=e=>i.wheels.filter(n=>(n.status in Wr?n.status:"")===e).length;return Object.entries(Wr).filter(([e])=>t(e)).map(([e,n])=>Mm(n,`${e||"not stated"} (${t(e)})`))}function ZS(i){if(!i.wheels.some(n=>typeof n.loss=="number"))return[M("li",{},"No losses, because the train declares no loads or friction.")];let e=`power loss at the meshes: 0 to ${(Math.max(...i.wheels.map(n=>n.loss??0))*100).toPrecision(2)} % of the input power`;return[Mu(gl(0,1),gl(1,1),e)]}function no(i,t){let e={speed:$S,status:YS,loss:ZS}[t]?.(i)??[];return M("ul",{class:"legend","aria-label":"legend",hidden:!e.length},e)}async function bm(i){let t=i.filter(({stage:o})=>o),e=t.filter(({stage:o})=>o.renderer),n=e.length?e:t;if(!n.length)return;let s=n.map(({stage:o})=>o),r=n.map(({scene:o})=>o.name);wu(e.length?await gm(s):_m(s),Su(r,e.length?"png":"svg"))}function Su(i,t){return`${[...new Set(i.filter(Boolean))].join("-").replace(/[^\w.+-]+/g,"-")}.${t}`}function wu(i,t){let e=URL.createObjectURL(i),n=document.createElement("a");n.href=e,n.download=t,n.click(),setTimeout(()=>URL.revokeObjectURL(e),1e4)}var JS=30,KS="M12 5a7 7 0 1 0 0 14a7 7 0 0 0 0-14z",jS="M6 6h12v12H6z",QS=["video/webm;codecs=vp9","video/webm;codecs=vp8","video/webm"];function tw(){return!HTMLCanvasElement.prototype.captureStream||!globalThis.MediaRecorder?null:QS.find(i=>MediaRecorder.isTypeSupported(i))??null}var Ql=class{constructor(){this.type=tw(),this.recorders=[],this.node=M("button",{type:"button",class:"record","aria-label":"Record film","aria-pressed":"false",title:"Record film",onclick:()=>this.toggle()}),this.use([])}use(t){this.stop(),this.sides=t.filter(({stage:e})=>e?.renderer),this.node.hidden=!this.type||!this.sides.length}toggle(){this.recorders.length?this.stop():this.start()}start(){this.recorders=this.sides.map(t=>this.#t(t)),this.#e(!0)}#t({scene:t,stage:e}){let n=e.canvas.captureStream(JS),s=new MediaRecorder(n,{mimeType:this.type}),r=[];return s.addEventListener("dataavailable",({data:o})=>r.push(o)),s.addEventListener("stop",()=>{for(let o of n.getTracks())o.stop();wu(new Blob(r,{type:"video/webm"}),Su([t.name,t.state],"webm"))}),s.start(),e.request(),s}stop(){for(let t of this.recorders)t.state!=="inactive"&&t.stop();this.recorders=[],this.#e(!1)}#e(t){this.node.setAttribute("aria-pressed",String(t)),this.node.replaceChildren(mn(t?jS:KS))}};var ew="(max-width: 820px), (max-height: 520px)",nw={front:"Front",back:"Back",side:"Side",free:"Free"},tc=class{constructor(t){this.sides=[],this.mode="plain",this.looking="free",this.looks=Object.entries(nw).map(([e,n])=>M("button",{type:"button","data-look":e,"aria-pressed":"false",onclick:()=>this.look(e)},n)),this.colour=M("select",{"aria-label":"Colours",onchange:()=>this.paint(this.colour.value)},Object.entries(bu).map(([e,n])=>M("option",{value:e},n))),this.apart=M("input",{type:"range",min:0,max:1,step:.01,value:0,oninput:()=>this.#i()}),this.front=M("input",{type:"checkbox",onchange:()=>this.#n(e=>e.hideFront(this.front.checked))}),this.teeth=M("input",{type:"checkbox",onchange:()=>this.#n(e=>e.showTeeth(this.teeth.checked))}),this.open=M("input",{type:"checkbox",onchange:()=>this.#r(this.wanted=this.open.checked)}),this.names=M("input",{type:"checkbox",onchange:()=>this.#s()}),this.status=M("button",{type:"button","aria-pressed":"false",onclick:()=>this.paint(this.mode==="status"?"plain":"status")},"Status"),this.opening=ke("Cut open",this.open,{class:"field tick"}),this.recording=new Ql,this.teeth.checked=t?.teeth!==!1,this.row=M("div",{class:"tools",role:"group","aria-label":"picture"},M("div",{class:"group",role:"group","aria-label":"view from"},this.looks),this.colour,this.status,ke("Apart",this.apart),ke("Hide front",this.front,{class:"field tick"}),ke("Names",this.names,{class:"field tick"}),ke("Teeth",this.teeth,{class:"field tick"}),this.opening),this.files=M("div",{class:"group",role:"group","aria-label":"files"},M("button",{type:"button",class:"save","aria-label":"Save picture",onclick:()=>bm(this.sides)},"Save"),this.recording.node),this.node=M("details",{class:"fold"},M("summary",{},"Picture"),this.row),this.small=matchMedia(ew),this.names.checked=!this.small.matches,this.#t(()=>this.node.open=!this.small.matches)}#t(t){this.small.addEventListener("change",t),t()}lodge(t,e){this.#t(()=>(this.small.matches?this.row:t).append(...e,this.files))}use(t){this.sides=t,this.recording.use(t);let e=t.flatMap(({stage:n})=>n??[]);this.opening.hidden=!e.some(n=>n.canOpen),this.open.checked=this.wanted??e.some(n=>n.world?.opened),this.#n(n=>{n.onOrbit=()=>this.#e(null),n.hideFront(this.front.checked),n.showTeeth(this.teeth.checked)}),this.status.hidden=!t.some(({scene:n})=>n.wheels.some(({status:s})=>s)),this.#s(),this.wanted!==void 0&&this.#r(this.wanted),this.#i(),this.look(this.looking),this.paint(this.mode)}dress(t,e){e.hideFront(this.front.checked),e.showTeeth(this.teeth.checked),e.explode(Number(this.apart.value)),e.paint(this.mode),t.legend.replaceChildren(no(t.scene,this.mode))}#e(t){for(let e of this.looks)e.setAttribute("aria-pressed",String(e.dataset.look===t))}#n(t){for(let e of this.sides)e.stage&&t(e.stage)}#s(){for(let{callouts:t}of this.sides)t?.show(this.names.checked)}#r(t){this.#n(e=>e.cutOpen?.(t))}#i(){this.apart.setAttribute("aria-valuetext",`${Math.round(this.apart.value*100)} %`),this.#n(t=>t.explode(Number(this.apart.value)))}look(t){this.looking=t,this.#e(t),this.#n(e=>e.look(t))}paint(t){this.mode=t,this.colour.value=t,this.status.setAttribute("aria-pressed",String(t==="status"));for(let e of this.sides)e.legend.replaceChildren(no(e.scene,t));this.#n(e=>e.paint(t))}next(){let t=Object.keys(bu);this.paint(t[(t.indexOf(this.mode)+1)%t.length])}toggle(t){t.checked=!t.checked,t.dispatchEvent(new Event("change"))}assemble(){this.apart.value=0,this.#i()}takeApart(){this.apart.value=Number(this.apart.value)>0?0:1,this.#i()}};var ns=class{constructor(t,e){Object.assign(this,{steps:t,onStep:e,at:-1});let n=(s,r)=>M("button",{type:"button",onclick:()=>this.go(this.at+r)},s);this.first=n(`Tour in ${t.length} steps`,1),[this.back,this.next]=[n("Back",-1),n("Next",1)],this.end=M("button",{type:"button",onclick:()=>this.go(-1)},"End"),this.text=M("p",{"aria-live":"polite"}),this.buttons=M("div",{class:"buttons"},this.back,this.next,this.end),this.node=M("section",{class:"tour","aria-label":"tour",hidden:!t.length},this.first,this.text,this.buttons),this.#t()}go(t){this.at=t<this.steps.length?t:-1,this.#t(),this.onStep(this.steps[this.at]??null)}#t(){let t=this.steps[this.at];this.first.hidden=!!t,this.text.hidden=this.buttons.hidden=!t,this.back.disabled=this.at===0,this.text.textContent=t?`${this.at+1}/${this.steps.length} ${t.text}`:""}};var iw=100,Tu=class{constructor(t){this.app=t,this.all=t.scenes.map((n,s)=>new jl(t,s));let e=this.all[0].scene;this.drive=new Xs(t,nt.of(e.step)),this.drive.rate=Sl(e),t.machines[0].moves&&(this.drive.at=wl(e)),this.live=new kl,this.tools=new tc(t.options),this.theme=new Ys(n=>this.all.forEach(({stage:s})=>s?.theme({background:n}))),this.theme.apply(),this.crank=new Zr(e,this.drive,{set:n=>this.setTo(n)}),this.keys=new Bl({timed:this.all.some(({machine:n})=>n.run),drive:this.drive,tools:this.tools,goTo:()=>this.crank.find(),find:()=>this.panel.find(),back:()=>this.crank.turnBack?.(),escape:()=>this.letGo()}),this.head=new Fl(this.all,{compare:!!t.options?.compare,theme:this.theme.select,onKeys:()=>this.keys.open(),onChanged:()=>this.panel.showChange(),onShow:n=>this.show(n),onLoop:(n,s)=>this.loop(n,s),onElement:(n,s)=>this.element(n,s)}),this.tools.lodge(this.head.choices,this.head.rest),this.panel=new Yl(this),this.tour=new ns([],()=>{}),this.#t(),this.drive.listen((n,s)=>this.#e(n,s)),this.show(this.head.sides)}#t(){let t=M("div",{class:"views"},this.all.map(e=>e.figure));document.body.prepend(M("a",{class:"skip",href:"#panel"},"Skip to the panels"),M("div",{class:"house"},this.head.node,M("main",{class:"hall"},this.tools.node,t,this.tour.node,this.crank.node),this.panel.node),this.live.node,this.keys.node)}#e(t,e){let n=performance.now(),s=e||n-(this.worded??0)>iw;s&&(this.worded=n),this.crank.set(t,e),this.panel.set(s),e&&this.live.rest(t)}show(t){this.sides=t;for(let e of this.all)e.figure.hidden=!t.includes(e),e.figure.hidden&&e.close();document.body.classList.toggle("beside",t.length>1),this.panel.use(t),this.live.use(t),this.#r(t),this.#n(t[0]),this.lit&&this.openStages(),this.letGo(),this.drive.goTo(this.drive.at),this.crank.set(this.drive,!0),this.panel.set(!0)}openStages(){for(let t of this.sides){if(!t.open())continue;let{stage:e}=t;e.theme({background:this.theme.background}),e.onPick=n=>this.select(t,n),e.onCrank=n=>this.drive.advance(n/Number(this.app.gears[t.index]),!0),this.lit&&e.cut()}this.tools.use(this.sides);for(let{stage:t}of this.sides)t?.resize();this.lit=!0}#n(t){let e=new ns(t.scene.tour,n=>this.#s(t,n));this.tour.node.replaceWith(e.node),this.tour=e}#s({stage:t},e){this.tools.assemble(),t?.visit&&t.visit(e,this.#a,this.drive.calm.matches),e||this.tools.look("free")}begin(){this.drive.calm.matches||this.drive.play(!0)}#r(t){let[e,n]=t;this.drive.play(!1),this.drive.step=nt.of(e.scene.step),this.drive.run=e.machine.run??null,this.drive.movable=t.some(({movable:r})=>r),this.app.gears=this.all.map(r=>r===n?r.gearing(e):nt.of(1));let s=this.drive.run?new Gl(e,this.drive):new Zr(e.scene,this.drive,{beside:n?.beside(e),set:r=>this.setTo(r)});this.crank.node.replaceWith(s.node),this.crank=s}select(t,e){for(let n of this.sides)n.stage?.select(n===t?e:null);this.panel.wheel(t,e),e!==null&&this.live.say(`wheel ${t.scene.wheels[e].id}, ${t.scene.wheels[e].teeth} teeth`)}count(t,e){let{name:n,formulas:s}=t.declared,r=o=>o.formulas&&o.declared.name===n&&String(o.formulas.given.wheels)===String(s.wheels);this.#i(this.all.filter(r),o=>o.change(e)),this.live.say(t.steps.map(({wheel:o,count:a})=>`${o} ${a} teeth`).join(", ")||"all as declared")}setTo(t){this.#i(this.all.filter(({scene:e})=>e.epoch?.settings.length),e=>e.setTo(t)),this.live.say("set to the sky")}#i(t,e){let n=document.activeElement?.dataset?.key,s=this.panel.chosen;for(let r of t)e(r),r.redraw(o=>this.tools.dress(r,o));this.drive.movable=this.sides.some(({movable:r})=>r),this.drive.movable||this.drive.play(!1),this.head.write(),this.panel.use(this.sides),this.live.use(this.sides),this.crank.use?.(this.sides[0].scene),s&&this.panel.wheel(...s),n&&document.querySelector(`[data-key="${CSS.escape(n)}"]`)?.focus({preventScroll:!0}),this.drive.goTo(this.drive.at),this.panel.set(!0)}choose(t){let e=this.sides.map(s=>({side:s,pointer:s.scene.pointers.find(r=>r.output===t)})).filter(({pointer:s})=>s),n=new Map(e.map(({side:s,pointer:r})=>[s,{wheels:r.wheels}]));this.#o(n),this.panel.path(t,e),this.live.say(`path to ${t}: ${e.map(({pointer:s})=>`${s.pairs.length} pairs`).join(", ")}`)}contact(t,e){let{name:n,kind:s}=t.scene.run.contacts[e],r=l=>l.findIndex(({id:c})=>c===n),o=t.scene.couplings[r(t.scene.couplings)],a=s==="pin"?[o.pin,o.slot]:[r(t.scene.bodies)];this.#o(new Map([[t,s==="pair"?{pairs:[n]}:{bodies:a}]])),this.live.say(`${n} is shown`)}element(t,{bodies:e,closed:n,text:s}){this.#o(new Map([[t,{bodies:e}]])),this.live.say(`${s}; it is ${n?"closed":"open"}`)}loop(t,e){this.#o(new Map([[t,e]]),fl),this.live.say(`the loop ${e.pairs.join(", ")} is shown in red`)}#o(t,e=this.#a){for(let n of this.sides)n.stage?.highlight(t.get(n)??null,e)}get#a(){return getComputedStyle(document.documentElement).getPropertyValue("--way").trim()}letGo(){this.#o(new Map),this.select(this.sides[0],null),this.panel.letGo()}};function Sm(i){i.interface=new Tu(i)}var Eu=["free","front","side","back"],sw="M2 12c3-5 6.5-7 10-7s7 2 10 7c-3 5-6.5 7-10 7s-7-2-10-7zM12 9.5a2.5 2.5 0 1 0 0 5 2.5 2.5 0 0 0 0-5z",rw="M3 5h9l8 7-8 7H3zM8 12h.01",ow="M12 3a9 9 0 1 0 0 18c2 0 2-3 0-4s0-3 3-3h4c1-6-3-11-7-11zM8 9h.01M14 7h.01",aw="M12 3l9 4.5-9 4.5-9-4.5zM3 12l9 4.5 9-4.5M3 16.5l9 4.5 9-4.5",lw=45,cw=6,hw=90,io=class{static asked(t,e){let[,n,s]=/^#(embed|kiosk)(?:=(\d{1,5}))?$/.exec(t)??[null,e];return n!=="embed"&&n!=="kiosk"?null:{kiosk:n==="kiosk",idle:1e3*Math.max(1,Number(s??lw))}}constructor(t,{kiosk:e,idle:n}){Object.assign(this,{app:t,kiosk:e,idle:n}),this.index=Math.max(0,t.machines.findIndex(r=>r.moves)),this.scene=t.scenes[this.index],e&&this.scene.epoch?.settings.length&&this.#t();let{run:s}=t.machines[this.index];this.drive=new Xs(t,nt.of(this.scene.step)),this.drive.run=s??null,this.drive.rate=s?gu(s)/s.period:Sl(this.scene),this.drive.movable=t.machines[this.index].moves,this.drive.movable&&(this.drive.at=this.moment??wl(this.scene)),this.look=0,this.theme=new Ys(r=>this.stage?.theme({background:r})),this.theme.apply(),this.#e(),this.drive.listen(()=>this.#d()),this.drive.goTo(this.drive.at),e&&this.#f()}#t(){let t=Cl();this.moment=Vs(this.scene,t),this.scene=this.app.scenes[this.index]=Rl(this.scene,t),this.app.machines[this.index]=new _i(this.scene)}#e(){let t=(h,u,d)=>M("button",{type:"button",onclick:h,"aria-label":u,title:u},mn(d),M("span",{},u));this.playing=t(()=>this.#r(),"Turn",Ws),this.playing.disabled=!this.drive.movable;let e=t(()=>this.#i(),"Other side",sw);this.apart=t(()=>this.#l(),"Take apart",aw),this.turns=M("output",{class:"quiet"}),this.place=M("div",{class:"place"});let{title:n,name:s,state:r,verdict:o,wheels:a}=this.scene,l=this.drive.movable?[this.turns,this.kiosk&&this.#n()]:M("p",{class:"bad"},o.text),c=this.kiosk&&[t(()=>this.callouts?.show(!this.callouts.shown),"Names",rw),a.some(({status:h})=>h)&&t(()=>this.#o(this.mode==="status"?"plain":"status"),"Status",ow)];this.tour=new ns(this.kiosk?this.scene.tour:[],h=>this.#a(h)),this.legend=M("div",{}),document.body.classList.add("showcase"),document.body.classList.toggle("kiosk",this.kiosk),document.body.prepend(M("main",{},this.place,M("header",{},M("h1",{},n||s,r&&` (${r})`),this.kiosk&&M("p",{},Tl(this.scene)),l,this.legend),this.tour.node,M("div",{class:"buttons",role:"group","aria-label":"the train"},this.playing,e,this.apart,c)))}#n(){let{scene:t,index:e,app:n}=this;t.epoch&&!t.epoch.unset.length&&(this.epoch=new jn(t.epoch)),this.date=this.epoch&&M("output",{class:"date"});let r=(t.asks?t.pointers.map((a,l)=>l):[]).sort((a,l)=>(t.pointers[a].dial===null)-(t.pointers[l].dial===null));this.read=r.slice(0,cw).map(a=>({hand:new sn(t,n.machines[e],a),value:M("dd")}));let o=this.read.map(({hand:a,value:l})=>M("div",{class:a.dial&&`hand-${a.order%nn.length}`},M("dt",{},a.pointer.output),l));return[this.date,M("dl",{class:"read"},o)]}openStages(){this.stage=this.app.open(this.index);let{canvas:t}=this.stage;t.setAttribute("role","img"),t.setAttribute("aria-label",`${this.scene.title||this.scene.name}, turning`),this.place.append(t),this.kiosk&&this.stage.renderer&&this.place.append((this.callouts=new $s(this.stage)).node),this.stage.theme({background:this.theme.background}),this.stage.onCrank=e=>this.drive.advance(e,!0),this.stage.resize(),this.kiosk?this.#h():this.#s()}#s(){this.drive.calm.matches||new IntersectionObserver(t=>{let e=t.at(-1).isIntersecting;e&&!this.stopped?this.drive.play(!0):e||this.drive.play(!1)}).observe(this.place)}#r(){this.drive.play(),this.stopped=!this.drive.playing}#i(){this.look=(this.look+1)%Eu.length,this.stage?.look(Eu[this.look])}#o(t){this.mode=t,this.stage?.paint(t),this.legend.replaceChildren(no(this.scene,t))}#a(t){this.#l(!1);let e=getComputedStyle(document.documentElement).getPropertyValue("--way").trim();this.stage?.visit?.(t,e,this.drive.calm.matches)}#l(t=!this.pulled){this.pulled=t,this.#c(this.apart,t?"Together":"Take apart"),this.stage?.explode(t?1:0),this.stage?.look(Eu[this.look])}#c(t,e){t.setAttribute("aria-label",e),t.title=e,t.querySelector("span").textContent=e}#d(){let{drive:t,scene:e}=this,n=e.bodies[e.driving_link]?.id??"the input";this.turns.textContent=t.run?`${t.time.toFixed(2)} s`:`${Hs(t.at,2)} turns of ${n}`,this.epoch&&(this.date.textContent=ts(this.epoch.dateAt(nt.of(t.at)))),this.read?.forEach(({hand:s,value:r})=>r.textContent=zs(s.now)),this.shown!==t.playing&&(this.shown=t.playing,this.#c(this.playing,t.playing?"Stop":"Turn"),this.playing.querySelector("svg").replaceWith(mn(t.playing?Jr:Ws)))}#f(){document.addEventListener("contextmenu",t=>t.preventDefault()),document.addEventListener("click",()=>{document.fullscreenElement||document.documentElement.requestFullscreen?.().catch(()=>{})});for(let t of["pointerdown","pointermove","wheel","keydown"])document.addEventListener(t,()=>this.#p(),{passive:!0,capture:!0})}#p(){this.alone=!1,clearTimeout(this.waiting),this.waiting=setTimeout(()=>this.#h(),this.idle)}#h(){this.alone=!0,this.look=0,this.tour.go(-1),this.#o("plain"),this.callouts?.show(!0),this.#l(!1),this.drive.play(!0),this.drive.calm.matches||this.#u(performance.now())}#u(t){requestAnimationFrame(e=>{let{controls:n}=this.stage;!this.alone||!n||(n.autoRotate=!0,n.autoRotateSpeed=60/hw,n.update(Math.min(e-t,100)/1e3),n.autoRotate=!1,this.#u(e))})}};var wm={type:"change"},Cu={type:"start"},Em={type:"end"},ec=new Vn,Tm=new qe,uw=Math.cos(70*Ih.DEG2RAD),Pe=new O,rn=2*Math.PI,se={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},Au=1e-6,nc=class extends Rr{constructor(t,e=null){super(t,e),this.state=se.NONE,this.target=new O,this.cursor=new O,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:Ii.ROTATE,MIDDLE:Ii.DOLLY,RIGHT:Ii.PAN},this.touches={ONE:Li.ROTATE,TWO:Li.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new O,this._lastQuaternion=new cn,this._lastTargetPosition=new O,this._quat=new cn().setFromUnitVectors(t.up,new O(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new Cs,this._sphericalDelta=new Cs,this._scale=1,this._panOffset=new O,this._rotateStart=new Dt,this._rotateEnd=new Dt,this._rotateDelta=new Dt,this._panStart=new Dt,this._panEnd=new Dt,this._panDelta=new Dt,this._dollyStart=new Dt,this._dollyEnd=new Dt,this._dollyDelta=new Dt,this._dollyDirection=new O,this._mouse=new Dt,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=fw.bind(this),this._onPointerDown=dw.bind(this),this._onPointerUp=pw.bind(this),this._onContextMenu=Mw.bind(this),this._onMouseWheel=_w.bind(this),this._onKeyDown=xw.bind(this),this._onTouchStart=vw.bind(this),this._onTouchMove=yw.bind(this),this._onMouseDown=mw.bind(this),this._onMouseMove=gw.bind(this),this._interceptControlDown=bw.bind(this),this._interceptControlUp=Sw.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(t){this._cursorStyle=t,t==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(t){super.connect(t),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=se.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(t){t.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=t}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(wm),this.update(),this.state=se.NONE}pan(t,e){this._pan(t,e),this.update()}dollyIn(t){this._dollyIn(t),this.update()}dollyOut(t){this._dollyOut(t),this.update()}rotateLeft(t){this._rotateLeft(t),this.update()}rotateUp(t){this._rotateUp(t),this.update()}update(t=null){let e=this.object.position;Pe.copy(e).sub(this.target),Pe.applyQuaternion(this._quat),this._spherical.setFromVector3(Pe),this.autoRotate&&this.state===se.NONE&&this._rotateLeft(this._getAutoRotationAngle(t)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let n=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(n)&&isFinite(s)&&(n<-Math.PI?n+=rn:n>Math.PI&&(n-=rn),s<-Math.PI?s+=rn:s>Math.PI&&(s-=rn),n<=s?this._spherical.theta=Math.max(n,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(n+s)/2?Math.max(n,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(Pe.setFromSpherical(this._spherical),Pe.applyQuaternion(this._quatInverse),e.copy(this.target).add(Pe),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=Pe.length();o=this._clampDistance(a*this._scale);let l=a-o;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){let a=new O(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;let c=new O(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(a),this.object.updateMatrixWorld(),o=Pe.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(ec.origin.copy(this.object.position),ec.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(ec.direction))<uw?this.object.lookAt(this.target):(Tm.setFromNormalAndCoplanarPoint(this.object.up,this.target),ec.intersectPlane(Tm,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>Au||8*(1-this._lastQuaternion.dot(this.object.quaternion))>Au||this._lastTargetPosition.distanceToSquared(this.target)>Au?(this.dispatchEvent(wm),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(t){return t!==null?rn/60*this.autoRotateSpeed*t:rn/60/60*this.autoRotateSpeed}_getZoomScale(t){let e=Math.abs(t*.01);return Math.pow(.95,this.zoomSpeed*e)}_rotateLeft(t){this._sphericalDelta.theta-=t}_rotateUp(t){this._sphericalDelta.phi-=t}_panLeft(t,e){Pe.setFromMatrixColumn(e,0),Pe.multiplyScalar(-t),this._panOffset.add(Pe)}_panUp(t,e){this.screenSpacePanning===!0?Pe.setFromMatrixColumn(e,1):(Pe.setFromMatrixColumn(e,0),Pe.crossVectors(this.object.up,Pe)),Pe.multiplyScalar(t),this._panOffset.add(Pe)}_pan(t,e){let n=this.domElement;if(this.object.isPerspectiveCamera){let s=this.object.position;Pe.copy(s).sub(this.target);let r=Pe.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*t*r/n.clientHeight,this.object.matrix),this._panUp(2*e*r/n.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(t*(this.object.right-this.object.left)/this.object.zoom/n.clientWidth,this.object.matrix),this._panUp(e*(this.object.top-this.object.bottom)/this.object.zoom/n.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(t,e){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let n=this.domElement.getBoundingClientRect(),s=t-n.left,r=e-n.top,o=n.width,a=n.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(t){return Math.max(this.minDistance,Math.min(this.maxDistance,t))}_handleMouseDownRotate(t){this._rotateStart.set(t.clientX,t.clientY)}_handleMouseDownDolly(t){this._updateZoomParameters(t.clientX,t.clientY),this._dollyStart.set(t.clientX,t.clientY)}_handleMouseDownPan(t){this._panStart.set(t.clientX,t.clientY)}_handleMouseMoveRotate(t){this._rotateEnd.set(t.clientX,t.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(rn*this._rotateDelta.x/e.clientHeight),this._rotateUp(rn*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(t){this._dollyEnd.set(t.clientX,t.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(t){this._panEnd.set(t.clientX,t.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(t){this._updateZoomParameters(t.clientX,t.clientY),t.deltaY<0?this._dollyIn(this._getZoomScale(t.deltaY)):t.deltaY>0&&this._dollyOut(this._getZoomScale(t.deltaY)),this.update()}_handleKeyDown(t){let e=!1;switch(t.code){case this.keys.UP:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(rn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),e=!0;break;case this.keys.BOTTOM:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(-rn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),e=!0;break;case this.keys.LEFT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(rn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),e=!0;break;case this.keys.RIGHT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(-rn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),e=!0;break}e&&(t.preventDefault(),this.update())}_handleTouchStartRotate(t){if(this._pointers.length===1)this._rotateStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._rotateStart.set(n,s)}}_handleTouchStartPan(t){if(this._pointers.length===1)this._panStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panStart.set(n,s)}}_handleTouchStartDolly(t){let e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enablePan&&this._handleTouchStartPan(t)}_handleTouchStartDollyRotate(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enableRotate&&this._handleTouchStartRotate(t)}_handleTouchMoveRotate(t){if(this._pointers.length==1)this._rotateEnd.set(t.pageX,t.pageY);else{let n=this._getSecondPointerPosition(t),s=.5*(t.pageX+n.x),r=.5*(t.pageY+n.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(rn*this._rotateDelta.x/e.clientHeight),this._rotateUp(rn*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(t){if(this._pointers.length===1)this._panEnd.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panEnd.set(n,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(t){let e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(t.pageX+e.x)*.5,a=(t.pageY+e.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enablePan&&this._handleTouchMovePan(t)}_handleTouchMoveDollyRotate(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enableRotate&&this._handleTouchMoveRotate(t)}_addPointer(t){this._pointers.push(t.pointerId)}_removePointer(t){delete this._pointerPositions[t.pointerId];for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId){this._pointers.splice(e,1);return}}_isTrackingPointer(t){for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId)return!0;return!1}_trackPointer(t){let e=this._pointerPositions[t.pointerId];e===void 0&&(e=new Dt,this._pointerPositions[t.pointerId]=e),e.set(t.pageX,t.pageY)}_getSecondPointerPosition(t){let e=t.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[e]}_customWheelEvent(t){let e=t.deltaMode,n={clientX:t.clientX,clientY:t.clientY,deltaY:t.deltaY};switch(e){case 1:n.deltaY*=16;break;case 2:n.deltaY*=100;break}return t.ctrlKey&&!this._controlActive&&(n.deltaY*=10),n}};function dw(i){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(i.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(i)&&(this._addPointer(i),i.pointerType==="touch"?this._onTouchStart(i):this._onMouseDown(i),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function fw(i){this.enabled!==!1&&(i.pointerType==="touch"?this._onTouchMove(i):this._onMouseMove(i))}function pw(i){switch(this._removePointer(i),this._pointers.length){case 0:this.domElement.releasePointerCapture(i.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(Em),this.state=se.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let t=this._pointers[0],e=this._pointerPositions[t];this._onTouchStart({pointerId:t,pageX:e.x,pageY:e.y});break}}function mw(i){let t;switch(i.button){case 0:t=this.mouseButtons.LEFT;break;case 1:t=this.mouseButtons.MIDDLE;break;case 2:t=this.mouseButtons.RIGHT;break;default:t=-1}switch(t){case Ii.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(i),this.state=se.DOLLY;break;case Ii.ROTATE:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=se.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=se.ROTATE}break;case Ii.PAN:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=se.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=se.PAN}break;default:this.state=se.NONE}this.state!==se.NONE&&this.dispatchEvent(Cu)}function gw(i){switch(this.state){case se.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(i);break;case se.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(i);break;case se.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(i);break}}function _w(i){this.enabled===!1||this.enableZoom===!1||this.state!==se.NONE||(i.preventDefault(),this.dispatchEvent(Cu),this._handleMouseWheel(this._customWheelEvent(i)),this.dispatchEvent(Em))}function xw(i){this.enabled!==!1&&this._handleKeyDown(i)}function vw(i){switch(this._trackPointer(i),this._pointers.length){case 1:switch(this.touches.ONE){case Li.ROTATE:if(this.enableRotate===!1){this.state=se.NONE;break}this._handleTouchStartRotate(i),this.state=se.TOUCH_ROTATE;break;case Li.PAN:if(this.enablePan===!1){this.state=se.NONE;break}this._handleTouchStartPan(i),this.state=se.TOUCH_PAN;break;default:this.state=se.NONE}break;case 2:switch(this.touches.TWO){case Li.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(i),this.state=se.TOUCH_DOLLY_PAN;break;case Li.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(i),this.state=se.TOUCH_DOLLY_ROTATE;break;default:this.state=se.NONE}break;default:this.state=se.NONE}this.state!==se.NONE&&this.dispatchEvent(Cu)}function yw(i){switch(this._trackPointer(i),this.state){case se.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(i),this.update();break;case se.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(i),this.update();break;case se.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(i),this.update();break;case se.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(i),this.update();break;default:this.state=se.NONE}}function Mw(i){this.enabled!==!1&&i.preventDefault()}function bw(i){i.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function Sw(i){i.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function Ru(i,t,e,n,s){let r=H(e).cross(t);r.length()<1e-6&&r.set(1,0,0),r.normalize();let o=t.clone().cross(r),a=(f,m)=>{let x=S=>Math.max(...i.map(w=>S*w.dot(f)+m*w.dot(t))),[p,g]=[x(1),x(-1)];return{middle:(p-g)/2,away:(p+g)/(2*m)}},[l,c]=[a(r,n),a(o,s)],h=r.multiplyScalar(l.middle).addScaledVector(o,c.middle),u=i.map(f=>f.dot(t)),d=(Math.min(...u)+Math.max(...u))/2;return{target:h.addScaledVector(t,d),distance:Math.max(l.away,c.away)-d}}var ww=6,ic=class{constructor(t){this.stage=t,this.ray=new Cr,this.plane=new qe,this.listeners={pointerdown:e=>this.down(e),pointermove:e=>this.move(e),pointerup:e=>this.up(e),pointercancel:()=>this.release()};for(let[e,n]of Object.entries(this.listeners))t.canvas.addEventListener(e,n,!0)}aim(t){let e=this.stage.canvas.getBoundingClientRect(),n=(t.clientX-e.left)/e.width*2-1,s=1-(t.clientY-e.top)/e.height*2;this.ray.setFromCamera(new Dt(n,s),this.stage.camera)}down(t){this.aim(t),this.from=[t.clientX,t.clientY],!(!this.stage.machine.moves||!this.onKnob())&&(this.dragged=this.crankAngle(),this.stage.controls.enabled=!1,this.stage.canvas.setPointerCapture(t.pointerId))}move(t){if(this.dragged===void 0)return;this.aim(t);let e=this.crankAngle();if(e===null)return;let n=this.dragged===null?0:e-this.dragged;this.dragged=e;let s=n-2*Math.PI*Math.round(n/(2*Math.PI)),r=this.stage.leadOf(s);r&&this.stage.onCrank(r)}up(t){let e=Math.hypot(t.clientX-this.from[0],t.clientY-this.from[1]);this.dragged===void 0&&e<=ww&&this.pick(t),this.release()}release(){this.dragged=void 0,this.stage.controls.enabled=!0}pick(t){this.aim(t),this.stage.onPick(this.stage.world.pick(this.ray.ray))}onKnob(){let{world:t}=this.stage,{crank:e}=t;return e!==null&&this.ray.ray.distanceToPoint(t.ofCrank(e.knob))<e.touch}crankAngle(){let{world:t,machine:e}=this.stage,n=e.scene.bodies[e.scene.crank],s=t.nodes[n.parent].matrixWorld,r=t.ofCrank(t.crank.at),o=H(n.direction).transformDirection(s);this.plane.setFromNormalAndCoplanarPoint(o,r);let a=this.ray.ray.intersectPlane(this.plane,H([0,0,0]));if(!a)return null;let[l,c]=[H([1,0,0]),H([0,1,0])],h=Math.abs(o.x)<.9?l:c;return h.addScaledVector(o,-h.dot(o)).normalize(),a.sub(r),Math.atan2(a.dot(o.clone().cross(h)),a.dot(h))}dispose(){for(let[t,e]of Object.entries(this.listeners))this.stage.canvas.removeEventListener(t,e,!0)}};var Tw=["frame","carrier","wall","drum","post","pillar","foot"],Am=.001,Cm=(i,{kind:t,body:e})=>Tw.includes(t)||t==="pin"&&i.wheels.some(n=>n.body===e&&n.kind==="ring");function Rm(i,t){let e=i.wheels.filter(({kind:f})=>f==="ring"),n=e.map(({body:f})=>i.bodies[f]),s=n.map(f=>e.filter((m,x)=>he(f.direction,n[x].direction)&&Zn(f,n[x].point)<Am*t)),[r]=s.toSorted((f,m)=>m.length-f.length);if(!r)return null;let{point:o,direction:a}=i.bodies[r[0].body],l=H(a).multiplyScalar(i.front*Math.sign(a[2]||1)),c=he(a,[0,1,0])?H([0,0,-1]):H([0,1,0]),h=c.addScaledVector(l,-c.dot(l)).normalize(),u=r.map(({centre:f})=>H(f).dot(l)),d=Math.max(...u)-Math.min(...u)>Am*t;return{at:H(o),up:h,right:h.clone().cross(l),hides:d}}function Pm({at:i,right:t,up:e},n){let s=n.clone().sub(i);return s.dot(t)>0&&s.dot(e)>0}var Im=8,Ew=[.25,.6,.95],Aw=.04;function Lm({at:i,direction:t,radius:e,inner:n=0}){let[s,r]=[Nn(t),H(t)],o=r.clone().cross(s);return Ew.flatMap(a=>{let l=n+a*(e-n);return Array.from({length:Im},(c,h)=>{let u=2*Math.PI*(h+a)/Im;return i.clone().addScaledVector(s,l*Math.cos(u)).addScaledVector(o,l*Math.sin(u))})})}function Pu(i){let[t,e]=Us(i);return{from:t,to:e,radius:Math.max(...i.bands.map(([,,n])=>n))}}var Dm=({place:i,direction:t,across:e,outlines:n})=>({inverse:$t(i,t,e).invert(),outline:n[0]});function Cw(i,t,e){let n=!1;for(let s=0,r=i.length-2;s<i.length;r=s,s+=2){let[o,a,l,c]=[i[r],i[r+1],i[s],i[s+1]];a>e!=c>e&&t<o+(e-a)/(c-a)*(l-o)&&(n=!n)}return n}var sc=class{constructor(t){this.wheels=t.wheels.map(e=>{let n={at:H(e.centre),direction:e.direction,radius:Jn(e),inner:e.kind==="ring"?e.radius:0};return{...n,isWorm:e.kind==="worm",points:Lm(n)}}),this.walls=t.parts.filter(({kind:e})=>e==="wall").map(Pu),this.points=this.wheels.flatMap(({points:e})=>e),this.swept=t.wheels.flatMap((e,n)=>al(t,e).map(s=>Lm({...s,inner:this.wheels[n].inner})))}isCovering({from:t,to:e,radius:n},s){let r=new Vn(s.clone()),o=s.clone(),a=l=>(r.direction.copy(l).sub(s).normalize(),r.distanceSqToSegment(t,e,o)<n*n&&o.distanceToSquared(s)<l.distanceToSquared(s));return this.swept.some(l=>l.filter(a).length>Aw*l.length)}hidden({inverse:t,outline:e},n){let s=n.clone().applyMatrix4(t),r=n.clone(),o=a=>{r.copy(a).applyMatrix4(t);let l=s.z/(s.z-r.z);return l>0&&l<1&&Cw(e,s.x+l*(r.x-s.x),s.y+l*(r.y-s.y))};return this.points.filter(o).length/this.points.length}seen(t){let[e,n]=[t.clone(),t.clone()],s=(o,a)=>this.wheels.some(l=>l!==a&&Pw(l,t,e.copy(o).sub(t),n)),r=this.wheels.map(o=>{let a=t.clone().sub(o.at),l=a.dot(H(o.direction))/a.length(),c=o.isWorm?Math.sqrt(1-l*l):Math.abs(l),h=o.points.filter(u=>!s(u,o)&&!this.walls.some(d=>Rw(d,t,u))).length/o.points.length;return Math.sqrt(c*h)});return r.reduce((o,a)=>o+a,0)/r.length}};function Rw({from:i,to:t,radius:e},n,s){let r=t.clone().sub(i),o=r.length();r.divideScalar(o);let a=p=>[p.dot(r),p.clone().addScaledVector(r,-p.dot(r))],[[l,c],[h,u]]=[n.clone().sub(i),s.clone().sub(n)].map(a),[d,f,m]=[u.dot(u),u.dot(c),c.dot(c)-e*e],x=Math.sqrt(f*f-d*m);return[(-f-x)/d,(-f+x)/d].some(p=>p>0&&p<1&&l+p*h>0&&l+p*h<o)}function Pw({at:i,direction:t,radius:e,inner:n},s,r,o){let a=H(t),l=a.dot(o.copy(i).sub(s))/a.dot(r);if(!(l>0&&l<1-1e-6))return!1;let c=o.copy(s).addScaledVector(r,l).distanceTo(i);return n<c&&c<e}var Iw={plate:Tt.plate,frame:Tt.case,carrier:Tt.plate,dial:Tt.case,pillar:Tt.plate,post:Tt.plate,foot:Tt.plate,pipe:Tt.pipe,barrel:Tt.pipe,weight:Tt.pipe,bob:Tt.plate,pin:Tt.pin,belt:Tt.mark,cord:Tt.mark,wheel:Kn[0],pulley:Kn[1],star:Kn[2],cross:Kn[2],rack:Kn[3],pinion:Kn[0],drum:Tt.case,box:Tt.slot,lid:Tt.pin,nut:Kn[4],guide:Tt.slot,road:Tt.arm,nave:Tt.arm,figure:Tt.bezel},Lw=["figure"],Dw=.5,Nm="wall",Lu=84,Nw=["post","pin"],Om=.06,Iu="drum",Ow=["frame","carrier","dial",Iu],Du=({kind:i})=>Iw[i]??Tt.arbor;function Um(i,t){return Bm(i,i.parts,t)}var Fm=(i,t)=>Bm(i,i.shapes,t);function Bm(i,t,e){return t.map(n=>{let{body:s,kind:r,place:o,direction:a,across:l}=n,c=n.outlines.length>0,h=he(a,e.toArray()),u=Ow.includes(r)?H(a):null,d=c?Ou(n):Lw.includes(r)?Fw(n.bands):Nu(Nw.includes(r)?Uw(n.bands):n.bands,r===Nm||r===Iu?Lu:40),f=r===Iu?Us(n)[0].lerp(Us(n)[1],.5):h&&!c?null:H(o);return{body:s,kind:r,cover:u,colour:Du(n),gloss:c?Dw:.8,shape:d,matrix:$t(o,a,l),at:f,plate:c,pane:r==="frame"?Dm(n):null,bar:r==="pillar"?Pu(n):null,wall:r===Nm?Us(n):null,opened:Cm(i,n)}})}function Uw(i){let[[t,,e],[,n,s]]=[i[0],i.at(-1)];return i.map(([r,o,a,l])=>[r===t?r-Om*e:r,o===n?o+Om*s:o,a,l])}function Nu(i,t){let e=new Gt,n=[];return i.forEach((s,r)=>{if(n.push(s),r+1<i.length&&i[r+1][0]-s[1]<1e-6)return;let o=n.flatMap(([l,c,h])=>[[h,l],[h,c]]),a=n.toReversed().flatMap(([l,c,,h])=>[[h,c],[h,l]]);ee(e,Bw([...o,...a]),Math.max(14,Math.min(t,Math.round(10*Math.max(...n.map(([,,l])=>l)))))),n=[]}),e}function Fw(i){let t=i.map(([e,n,s])=>[s,(e+n)/2]);return ee(new Gt,[[0,i[0][0]],[i[0][2],i[0][0]],...t,[0,i.at(-1)[1]]],32)}function Bw(i){let t=i.map(([,s])=>s),[e,n]=[Math.min(...t),Math.max(...t)];return i.flatMap(([s,r],o)=>{let a=i.at(o-1),l=i[(o+1)%i.length],c=Math.min(.15*s,.1*(n-e));return r===e&&a[1]===e&&a[0]<s-2*c&&l[1]>e?[[s-c,r],[s,r+c]]:r===n&&l[1]===n&&l[0]<s-2*c&&a[1]<n?[[s,r-c],[s-c,r]]:[[s,r]]})}function Ou({outlines:i,height:t},e=0){let n=new Gt,s=i.map(a=>{let l=[];for(let c=0;c<a.length;c+=2)l.push(new Dt(a[c],a[c+1]));return l.length>1&&l[0].distanceTo(l.at(-1))<1e-9&&l.pop(),l});s.forEach((a,l)=>{Ai.isClockWise(a)===(l===0)&&a.reverse()});let r=Ai.triangulateShape(s[0],s.slice(1)),o=s.flat();for(let a of[-1,1]){let l=n.corners;for(let{x:c,y:h}of o)n.corner([c,h,a*t/2],[0,0,a],[1,0,0]);for(let[c,h,u]of r)n.indices.push(l+c,l+h,l+u)}for(let a of s.slice(e))kw(n,a,t/2);return n}function kw(i,t,e){t.forEach(({x:n,y:s},r)=>{let o=t[(r+1)%t.length],[a,l]=[o.x-n,o.y-s],c=Math.hypot(a,l)||1;i.face([[n,s,-e],[o.x,o.y,-e],[o.x,o.y,e],[n,s,e]],[l/c,-a/c,0],[a/c,l/c,0])})}function so(i,t){let e=i.bodies[t];return i.parts.filter(({body:n,bands:s,direction:r,place:o})=>n===t&&s.length&&he(r,e.direction)&&Zn(e,o)<1e-6).flatMap(({bands:n,direction:s,place:r})=>{let[o,a]=[Me(e,r),Math.sign(H(s).dot(H(e.direction)))];return n.map(([l,c,h])=>[...[o+a*l,o+a*c].sort((u,d)=>u-d),h])})}function Uu(i,t){return i.flatMap(({body:e,kind:n,place:s,direction:r,across:o,bands:a,outlines:l,height:c})=>{let h=$t(s,r,o),u=(l[0]??[]).flatMap((m,x,p)=>x%2?[]:[[m,p[x+1],c/2],[m,p[x+1],-c/2]]),d=a.flatMap(([m,x,p])=>[m,x].flatMap(g=>[[p,0,g],[-p,0,g],[0,p,g],[0,-p,g]])),f=a.length&&he(r,t.toArray())?null:H(s);return[...u,...d].map(m=>({point:H(m).applyMatrix4(h),body:e,kind:n,at:f}))})}function rc(i,t,e){let n=t.clone().sub(i),s=n.length();if(s<1e-9)return{shape:new Gt,matrix:$t(i.toArray(),[0,0,1],[1,0,0])};let r=n.divideScalar(s).toArray();return{shape:Un(e,0,s),matrix:$t(i.toArray(),r,Nn(r).toArray())}}function Fu(i,t,e,n,s){let r=t.clone().sub(i),o=r.length(),a=s/2,l=wn(new Gt,xl(o,...n,.62*Math.min(...n)),-a,a),c=new Gt;return ee(c,ye(0,.72*n[1],-.9*s,.9*s),16),{shape:l,matrix:$t(i.toArray(),e,r.toArray()),boss:{shape:c,matrix:$t(t.toArray(),e,r.toArray())}}}function km(i){let t=i.bodies.map(()=>[]);for(let e of i.wheels){let n=Me(i.bodies[e.body],e.centre);t[e.body].push(n-.9*e.thickness,n+.9*e.thickness)}for(let{pin:e,slot:n,pin_at:s,slot_at:r}of i.couplings)t[e].push(Me(i.bodies[e],s)),t[n].push(Me(i.bodies[n],r));for(let{body:e,place:n,height:s,direction:r,bands:o}of i.shapes){let a=o.length?[o[0][0],o.at(-1)[1]]:[-s,s];he(i.bodies[e].direction,r)&&t[e].push(...a.map(l=>Me(i.bodies[e],H(n).addScaledVector(H(r),l))))}for(let{body:e,dial:n}of i.pointers)n!==null&&!i.dials[n].plate&&i.dials[n].look!=="ball"&&t[e].push(Me(i.bodies[e],i.dials[n].centre));return i.bodies.forEach((e,n)=>so(i,n).forEach(([s,r])=>t[n].push(s,r))),t.map(e=>e.length?[Math.min(...e),Math.max(...e)]:null)}function zm(i,t,e){let n=i.bodies.map(()=>.012*e),s=new Set;return i.bodies.forEach((r,o)=>{if(s.has(o))return;let a=i.bodies.map((h,u)=>u).filter(h=>ol(i,o,h,e)),l=h=>t[h]?t[h][1]-t[h][0]:0;a.sort((h,u)=>l(u)-l(h));let c=Math.min(...i.wheels.filter(h=>a.includes(h.body)&&h.kind!=="ring").map(h=>.55*h.root),.012*e);a.forEach((h,u)=>{s.add(h),n[h]=c*(1+.7*u/Math.max(4,a.length))})}),n}function Gm(i,t,e,n){let s=[],r=zw(i.wheels.map(({thickness:o})=>o))||.01*n;return i.bodies.forEach((o,a)=>{if(o.parent===null||!t[a])return;let[l,c]=t[a],h=i.bodies[o.parent],u=h.parent!==null,d=he(h.direction,o.direction),[f,m]=[l,c];if(u&&d&&Zn(h,o.point)>1e-6*n){let x=Gw(i,o.parent,o,t[a],r);[f,m]=[Math.min(l,x),Math.max(c,x)];let p=be(o,x),g=be(h,Me(h,p)),S=Fu(g,p,o.direction,[2.6*e[o.parent],2.1*e[a]],.6*r);s.push({body:o.parent,colour:Tt.arm,...S,at:p,plate:!0},{body:o.parent,colour:Tt.arm,...S.boss,at:p,plate:!0}),t[o.parent]??=[Me(h,p),Me(h,p)]}else if(u&&!d){let x=Me(o,bp(o.point,o.direction,h.point,h.direction)),p=rc(be(o,x),be(o,(l+c)/2),.8*e[a]);s.push({body:o.parent,colour:Tt.arm,...p,at:null,plate:!0})}s.push({body:a,colour:Tt.arbor,...rc(be(o,f),be(o,m),e[a]),at:null})}),s}var zw=i=>[...i].sort((t,e)=>t-e)[i.length>>1];function Gw(i,t,e,[n,s],r){let a=i.wheels.filter(h=>h.body===t&&h.kind!=="ring").map(h=>Me(e,h.centre)),l=(n+s)/2;return a.sort((h,u)=>Math.abs(h-l)-Math.abs(u-l))[0]??n-.4*r}var oc=class{constructor(t,e,n,s){let{body:r,centre:o,direction:a}=n.wheel;Object.assign(this,{machine:t,wave:e,body:r,slots:n.slots,walls:new Map(s.map(l=>[l.slot,l.bottom]))}),this.frame=$t(o,a,e.towards),this.back=this.frame.clone().invert(),this.cast=new Map}turn(t){let{machine:e,wave:n,body:s}=this;this.where=e.moves?e.angle(n.by)-e.angle(s):0;for(let r of t)r.geometry&&this.#t(r)}#t(t){this.cast.has(t)||this.cast.set(t,this.#e(t));let{position:e}=t.geometry.attributes,n=new O;for(let{first:s,straight:r,share:o}of this.cast.get(t)){for(let a=0;a<r.length;a+=3){let[l,c]=this.bent(r[a],r[a+1],o(r[a+2]));n.set(l,c,r[a+2]).applyMatrix4(this.frame).toArray(e.array,3*s+a)}e.needsUpdate=!0}}#e({parts:t,geometry:e}){return t.filter(({slot:s})=>this.slots.includes(s)||this.walls.has(s)).map(({slot:s,first:r,last:o})=>{let a=e.attributes.position.array.slice(3*r,3*o),l=new O;for(let h=0;h<a.length;h+=3)l.fromArray(a,h).applyMatrix4(this.back).toArray(a,h);let c=this.walls.has(s)?this.walls.get(s).clone().applyMatrix4(this.back).z:null;return{first:r,straight:a,share:h=>c===null?1:Math.max(0,1-h/c)}})}bent(t,e,n=1){let{middle:s,lobes:r}=this.wave,o=n*this.wave.rise,a=Math.atan2(e,t),l=Math.hypot(t,e)-s,[c,h]=[Math.cos(r*(a-this.where)),Math.sin(r*(a-this.where))],u=-o/r*h,d=a+u/s,f=d+(r*o*h+u)/s,m=s+o*c;return[m*Math.cos(d)+l*Math.cos(f),m*Math.sin(d)+l*Math.sin(f)]}};var Zs=class{constructor(){this.jobs=[]}add(t,e,{body:n,slot:s,lift:r,count:o=1}){Vw(t),t.corners&&this.jobs.push({shape:t,matrix:e,body:n,slot:s,lift:r,count:o})}cast([t,e,n,s]){let r=d=>this.jobs.reduce((f,m)=>f+m.count*d(m.shape),0),o=r(d=>d.corners),a={position:new Te(new Float32Array(3*o),3),normal:new Te(new Int8Array(4*o),4,!0),grain:new Te(new Int8Array(4*o),4,!0),place:new Te(new Uint16Array(2*o),2),lift:new Te(new Float32Array(o),1)};this.index=new Uint32Array(r(d=>d.indices.length)),this.parts=[];let[l,c]=[0,0];for(let d of this.jobs){let[f,m]=[c,l];for(let x=0;x<d.count;x+=1){Hw(a,d,x,l);for(let p of d.shape.indices)this.index[c++]=l+p;l+=d.shape.corners}this.parts.push({body:d.body,slot:d.slot,from:f,to:c,first:m,last:l,ball:Ww(a.position.array,m,l)})}this.jobs=[];let h=new Te(this.index.slice(),1),u=(d,f)=>Object.assign(new en(d,f),{frustumCulled:!1,matrixAutoUpdate:!1});return this.meshes=[t,e,n].map(d=>{let f=new tn().setIndex(h);for(let[m,x]of Object.entries(a))f.setAttribute(m,x);return u(f,d)}),this.meshes[2].add(u(this.meshes[2].geometry,s)),this.geometry=this.meshes[0].geometry,this.meshes}distribute(t){let{index:e}=this.geometry,n=0;this.meshes.forEach((s,r)=>{let o=n;for(let{slot:a,from:l,to:c}of this.parts)t(a)===r&&(e.array.set(this.index.subarray(l,c),n),n+=c-l);s.geometry.setDrawRange(o,n-o),s.visible=n>o}),e.needsUpdate=!0}*met(t,e){if(!this.geometry)return;let{position:n,lift:s}=this.geometry.attributes,{index:r}=this,[o,a]=[[new O,new O,new O],new O],l=new dn;for(let c of this.parts){let h=t(c.body),u=e(s.array[r[c.from]]);if(l.copy(c.ball).radius+=u.length()+1e-9,!!h.intersectsSphere(l))for(let d=c.from;d<c.to;d+=3)o.forEach((f,m)=>f.fromBufferAttribute(n,r[d+m]).add(e(s.array[r[d+m]]))),h.intersectTriangle(...o,!1,a)&&(yield[a.distanceTo(h.origin),c])}}dispose(){for(let{geometry:t}of this.meshes??[])t.dispose()}};function Vw({points:i,normals:t,indices:e}){for(let n=0;n<e.length;n+=3){let[s,r,o]=[3*e[n],3*e[n+1],3*e[n+2]],a=0;for(let l=0;l<3;l+=1){let[c,h]=[(l+1)%3,(l+2)%3];a+=(t[s+l]+t[r+l]+t[o+l])*((i[r+c]-i[s+c])*(i[o+h]-i[s+h])-(i[r+h]-i[s+h])*(i[o+c]-i[s+c]))}a<0&&([e[n+1],e[n+2]]=[e[n+2],e[n+1]])}}function Hw({position:i,normal:t,grain:e,place:n,lift:s},{shape:r,matrix:o,body:a,slot:l,lift:c,count:h},u,d){let f=u?o.clone().multiply(new Qt().makeRotationZ(2*Math.PI*u/h)):o;Bu(i.array,3*d,3,f.elements,1,1,r.points),Bu(t.array,4*d,4,f.elements,0,127,r.normals),Bu(e.array,4*d,4,f.elements,0,127,r.grains);let m=d+r.corners;for(let x=d;x<m;x+=1)n.array[2*x]=a,n.array[2*x+1]=l;if(typeof c=="number")s.array.fill(c,d,m);else for(let x=d;x<m;x+=1)s.array[x]=c(new O().fromBufferAttribute(i,x))}function Bu(i,t,e,n,s,r,o){for(let a=0;a<o.length;a+=3,t+=e){let[l,c,h]=[o[a],o[a+1],o[a+2]];i[t]=r*(n[0]*l+n[4]*c+n[8]*h+s*n[12]),i[t+1]=r*(n[1]*l+n[5]*c+n[9]*h+s*n[13]),i[t+2]=r*(n[2]*l+n[6]*c+n[10]*h+s*n[14])}}function Ww(i,t,e){let n=[1/0,1/0,1/0],s=[-1/0,-1/0,-1/0];for(let o=3*t;o<3*e;o+=1)n[o%3]=Math.min(n[o%3],i[o]),s[o%3]=Math.max(s[o%3],i[o]);let r=new O(...n).add(new O(...s)).multiplyScalar(.5);return new dn(r,r.distanceTo(new O(...s)))}var Xw=.012,qw=.32,$w=.34,Yw=`
precision highp float;
uniform mat4 projectionMatrix, modelViewMatrix;
uniform vec2 middle, half_wide;
uniform float soft, low;
in vec3 position;
out vec2 off;
void main() {
  off = position.xy * (half_wide + soft); // to the right, and to the reader
  gl_Position = projectionMatrix * modelViewMatrix * vec4(middle.x + off.x, low, middle.y + off.y, 1.0);
}`,Zw=`
precision highp float;
uniform vec2 half_wide;
uniform float soft, dark;
in vec2 off;
out vec4 colour;
void main() {
  vec2 core = 0.72 * half_wide;
  vec2 away = off / (core + soft), near = off / (0.5 * core + 0.3 * soft); // a wide one, and one of what stands on the ground
  float wide = max(1.0 - dot(away, away), 0.0), narrow = max(1.0 - dot(near, near), 0.0);
  float shade = 0.6 * wide * wide + 0.4 * narrow;
  colour = vec4(0.0, 0.0, 0.0, dark * shade);
}`,ac=class{constructor(t,e){let n=r=>({value:r});this.uniforms={middle:n([0,0]),half_wide:n([1,1]),soft:n(qw*t),low:n(0),dark:n($w)};let s={glslVersion:di,vertexShader:Yw,fragmentShader:Zw,uniforms:this.uniforms,transparent:!0,depthWrite:!1};this.mesh=new en(new Mr(1.05,48),new Wn({...s,side:1})),this.mesh.matrixAutoUpdate=this.mesh.frustumCulled=!1,this.mesh.matrix.copy($t([0,0,0],H([1,0,0]).cross(H(e)).toArray(),[1,0,0])),this.back=this.mesh.matrix.clone().invert(),this.mesh.renderOrder=-1,this.size=t}fit(t){let e=t.map(c=>c.clone().applyMatrix4(this.back)),n=c=>e.reduce(([h,u],d)=>[Math.min(h,d[c]),Math.max(u,d[c])],[1/0,-1/0]),[[s,r],[o],[a,l]]=["x","y","z"].map(n);Number.isFinite(o)&&(this.uniforms.middle.value=[(s+r)/2,(a+l)/2],this.uniforms.half_wide.value=[(r-s)/2,(l-a)/2],this.uniforms.low.value=o-Xw*this.size)}dispose(){this.mesh.geometry.dispose(),this.mesh.material.dispose()}};function Hm(i,t,e){let[n,s]=[i.bodies[t.pin],i.bodies[t.slot]],[r,o]=[H(t.pin_at),H(t.slot_at)],a=Math.max(.005*e,Math.min(.012*e,.12*t.pin_radius)),l=4*a;if(t.hole)return Jw(t,n,s,l);let c=Un(a,-l/2,l/2,16),h=$t(t.pin_at,n.direction,Nn(n.direction).toArray()),u=[{body:t.pin,colour:Tt.pin,shape:c,matrix:h,at:r},{body:t.slot,colour:Tt.slot,...Kw(t,s,o,r,a),at:o}],d=be(n,Me(n,r));if(d.distanceTo(r)>1e-6*e){let f=H(n.direction).multiplyScalar(-l/2),{shape:m,matrix:x}=Fu(d.add(f),r.clone().add(f),n.direction,[1.8*a,1.6*a],.5*a);u.push({body:t.pin,colour:Tt.slot,shape:m,matrix:x,at:r})}return u}function Jw(i,t,e,n){let s=Un(i.pin_diameter/2,-n,n,24),r=i.hole/2,o=ee(new Gt,ye(r,1.12*r+.1,-.6*n,.6*n),48),a=c=>Nn(c.direction).toArray(),l=(c,h,u,d)=>f=>({body:c,colour:u,shape:d,matrix:$t(f,h.direction,a(h)),at:H(f)});return[...i.holes_at.map(l(i.slot,e,Tt.slot,o)),...i.pins_at.map(l(i.pin,t,Tt.pin,s))]}function Kw(i,t,e,n,s){let{pin_radius:r,offset:o}=i,[a,l]=[Math.max(0,Math.abs(r-o)-2*s),r+o+2*s],c=new Gt,h=s/2,u=(f,m,x,p)=>wn(c,[[f,p/2],[m,p/2]],-h,h,([g,S,w])=>[g,S+x,w]);for(let f of[1,-1])u(a,l,f*1.35*s,.6*s);u(l,l+.7*s,0,3.3*s),a>0&&u(0,a,0,3.3*s),ee(c,ye(0,2.4*s,-h,h),24);let d=n.clone().sub(e).toArray();return{shape:c,matrix:$t(e.toArray(),t.direction,d,i.slot_turn??0)}}function Wm(i,t,e,n,s,r){let o=i.bodies[t],a=be(o,e),l=$t(a.toArray(),o.direction,Nn(o.direction).toArray()),c=(p,g)=>l.clone().multiply(new Qt().makeTranslation(p,0,g)),h=.013*r,u=.045*r*n,d=wn(new Gt,xl(s,.022*r,.018*r,.013*r),-h/2,h/2),f=ee(new Gt,[[0,-u],[.011*r,-u],[.019*r,.5*u],[.016*r,u],[0,u]],24),m=[{colour:Tt.arbor,shape:d,matrix:l},{colour:Tt.arbor,shape:Un(.016*r,-h,h),matrix:l},{colour:$h,shape:f,matrix:c(s,u)},{colour:$h,shape:_l(.0165*r),matrix:c(s,2*u)}].map(p=>({body:t,at:a,...p})),x=H([s,0,u]).applyMatrix4(l);return{body:t,at:a,end:be(o,e+2*u),knob:x,touch:.06*r,reach:s,parts:m}}var ku={gloss:.5,colour:Tt.slot};function Xm(i,t,e,n,s){let{direction:r,parent:o}=i.bodies[t],a=be(i.bodies[t],e),l=$t(a.toArray(),H(r).multiplyScalar(n).toArray(),Nn(r).toArray()),[c,h,u]=i.drive==="motor"?jw(o,.075*s):i.fusee.length?t1(i.fusee):Qw(.09*s),d=c.map(f=>({body:t,at:a,matrix:l,...f}));return{body:t,at:a,end:a.clone().addScaledVector(H(r),n*u),knob:a,touch:.6*h,reach:h,parts:d}}function jw(i,t){let[e,n]=[.5*t,2.5*t],s=Array.from({length:11},(a,l)=>[l%2?.9:1,e+.2*t+l/10*(n-e-.4*t)]).flatMap(([a,l],c,h)=>[[(c?h[c-1][0]:a)*t,l],[a*t,l]]),r=ee(new Gt,[[0,e],[.8*t,e],...s,[.8*t,n],[0,n]],48),o=wn(new Gt,[[.8*t,.4*t],[1.25*t,.4*t]],1.1*t,1.9*t);return[[{...ku,shape:Un(.4*t,0,.35*t,32)},{colour:Tt.arbor,shape:Un(.15*t,-.1*t,e)},{...ku,body:i,shape:r},{...ku,colour:Tt.pin,body:i,shape:o}],1.25*t,n]}function Qw(i){let t=.5*i,e=ee(ee(new Gt,ye(.93*i,i,0,t),64),ye(0,i,0,.08*t),64),[n,s]=[new Gt,6],r=o=>[(.2+.7*o/(48*s))*i,2*Math.PI*o/48];for(let o=0;o<48*s;o+=1){let[[a,l],[c,h]]=[r(o),r(o+1)],u=(x,p,g)=>[x*Math.cos(p),x*Math.sin(p),g],[d,f]=[0,.035*i].map(x=>[[a+x,l],[c+x,h]]),m=.92*t;n.face([...d,...f.toReversed()].map(([x,p])=>u(x,p,m)),[0,0,1],[-Math.sin(l),Math.cos(l),0]);for(let[x,p]of[[d,-1],[f,1]]){let[[g,S],[w,b]]=x;n.face([u(g,S,0),u(w,b,0),u(w,b,m),u(g,S,m)],[p*Math.cos(l),p*Math.sin(l),0],[-Math.sin(l),Math.cos(l),0])}}return[[{colour:Tt.pipe,shape:e},{colour:Tt.arbor,shape:n},{colour:Tt.arbor,shape:Un(.2*i,0,1.2*t)}],i,1.2*t]}function t1(i){let[t,e]=[Math.max(...i),1.4*Math.max(...i)/i.length],n=i.flatMap((o,a)=>[[o+.2*e,a*e],[o-.3*e,(a+.5)*e]]),s=i.length*e,r=ee(new Gt,[[0,0],...n,[i.at(-1),s],[0,s]],64);return[[{colour:Tt.pipe,shape:r},{colour:Tt.pipe,shape:Un(1.1*t,-.8*e,0,64)}],1.1*t,s]}var Vm=.02;function qm({kind:i,length:t,down:e,parts:n},s){let r=t-s;if(i!=="pendulum"||r<=0)return n;let o=([a,l,...c])=>[[a,s*(.6-Vm),...c],[s*(.6+Vm),l-r,...c]];return n.map(a=>he(a.direction,e)?{...a,bands:a.bands.flatMap(o)}:{...a,place:H(a.place).addScaledVector(H(e),-r).toArray()})}function $m({point:i,direction:t,down:e,length:n,wide:s,parts:r}){let o=H(i);return r.length?r.map(a=>({colour:Du(a),shape:Nu(a.bands,Lu),matrix:$t(a.place,a.direction,a.across),at:o})):[{colour:Tt.pin,shape:Un(s,0,n),matrix:$t(i,e,t),at:o}]}var ro=256,e1=`
precision highp float;
precision highp int;
uniform mat4 viewMatrix, projectionMatrix;
uniform sampler2D poses, palette;
uniform vec3 axis, middle;
uniform float share;
in vec3 position;
in vec3 normal;
in vec3 grain;
in vec2 place; // body, slot
in float lift;
out vec3 facing, brushed, seen;
out vec4 paint;
out float gloss, deep;
#ifdef CUT
uniform vec3 edge, right, up;
out vec3 quarter;
flat out vec2 reader;
#endif
vec4 pose(int at) { return texelFetch(poses, ivec2(at % ${ro}, at / ${ro}), 0); }
void main() {
  int slot = 2 * int(place.y + 0.5);
  ivec2 at = ivec2(slot % 256, slot / 256);
  paint = texelFetch(palette, at, 0);
  vec2 kind = texelFetch(palette, at + ivec2(1, 0), 0).rg;
  gloss = kind.r;
  int body = 4 * int(place.x + 0.5);
  mat4 model = mat4(pose(body), pose(body + 1), pose(body + 2), pose(body + 3));
  vec4 world = model * vec4(position + axis * (share * lift), 1.0);
  vec4 eye = viewMatrix * world;
#ifdef CUT
  vec3 off = world.xyz - edge;
  quarter = vec3(dot(off, right), dot(off, up), kind.g);
  vec3 from = -(transpose(mat3(viewMatrix)) * viewMatrix[3].xyz) - edge;
  reader = vec2(dot(from, right), dot(from, up));
#endif
  seen = eye.xyz;
  facing = mat3(viewMatrix) * (mat3(model) * normal);
  brushed = mat3(viewMatrix) * (mat3(model) * grain);
  deep = eye.z - (viewMatrix * vec4(middle, 1.0)).z;
  gl_Position = projectionMatrix * eye;
}`,n1=`
precision highp float;
uniform float size;
in vec3 facing, brushed, seen;
in vec4 paint;
in float gloss, deep;
#ifdef CUT
in vec3 quarter;
#endif
out vec4 colour;
const vec3 KEY = vec3(-0.45, 0.68, 0.58), FILL = vec3(0.75, 0.1, 0.65);
// squares in a row are cheaper than powers, and a picture has a million points
float square(float x) { return x * x; }
float power16(float x) { return square(square(square(square(x)))); }
float sheen(vec3 n, vec3 v, vec3 t, vec3 lamp, float brush) {
  vec3 half_way = normalize(lamp + v);
  float facing = max(dot(n, half_way), 0.0);
  float plain = square(power16(facing));
  float turned = power16(max(1.0 - square(dot(t, half_way)), 0.0)) * min(1.0, square(facing) * 1.3);
  return mix(plain, turned, 0.65 * brush);
}
// the room that metal mirrors: a dark floor, a light ceiling, a window and a lamp, soft as brushed metal shows them
float room(vec3 r) {
  float above = clamp(0.34 + 0.55 * r.y, 0.06, 0.72);
  float window = square(max(1.0 - 6.0 * square(r.x + 0.3) - 5.0 * square(r.y - 0.5), 0.0));
  float lamp = max(1.0 - 10.0 * square(r.x - 0.65), 0.0);
  float horizon = max(1.0 - 16.0 * square(r.y + 0.15), 0.0);
  return above + window + 0.35 * lamp - 0.18 * horizon;
}
void main() {
  vec3 v = normalize(-seen);
  vec3 n = normalize(facing);
#ifdef CUT
  if (quarter.z > 0.5 && quarter.x > 0.0 && quarter.y > 0.0) discard;
#endif
  vec3 own = paint.rgb * paint.rgb;
  float lit = 0.30 + 0.16 * n.y + 0.62 * max(dot(n, KEY), 0.0) + 0.22 * max(dot(n, FILL), 0.0);
  vec3 light = own * lit * mix(1.22, 0.62, gloss);
  if (gloss > 0.1) { // else of ink, or of a dial
    float brush = step(0.25, dot(brushed, brushed));
    vec3 t = brush * normalize(brushed + vec3(1e-9));
    float rim = square(square(1.0 - max(dot(n, v), 0.0)));
    vec3 glint = mix(vec3(1.0), own * 1.9, 0.62) * (0.53 * sheen(n, v, t, KEY, brush) + 0.22 * sheen(n, v, t, FILL, brush) + 0.08 * rim);
    light += gloss * (glint + 0.66 * mix(own * 1.75, vec3(1.0), 0.08 + 0.5 * rim) * room(reflect(-v, n)));
  }
  light *= clamp(1.0 + 0.62 * deep / size, 0.62, 1.1); // what lies deeper is darker
  float most = max(light.r, max(light.g, light.b)); // what is too bright keeps its hue
  light *= most > 0.7 ? (1.0 - 0.09 / (most - 0.4)) / most : 1.0;
  colour = vec4(sqrt(light), paint.a);
}`,i1=`
precision highp float;
uniform float size;
uniform vec3 section;
in vec3 facing, seen, quarter;
in float deep;
flat in vec2 reader;
out vec4 colour;
void main() {
  vec2 a = reader, b = quarter.xy, at = a / (a - b); // where the way from the reader goes in or out, as a part of the way
  vec2 low = mix(vec2(0.0), at, lessThanEqual(a, vec2(0.0))), high = mix(vec2(1.0), at, lessThanEqual(b, vec2(0.0)));
  bool through = all(greaterThan(max(a, b), vec2(0.0))) && max(low.x, low.y) < min(high.x, high.y);
  if (!through || all(greaterThan(b, vec2(0.0))) || dot(facing, -seen) > -0.1 * length(facing) * length(seen)) discard;
  colour = vec4(sqrt(section * clamp(1.0 + 0.62 * deep / size, 0.62, 1.1)), 1.0);
}`;function Ym(i,t,e,n,s){let r=Math.max(1,Math.ceil(4*i/ro)),o=new Ei(new Float32Array(4*ro*r),ro,r,Ke,pn);o.minFilter=o.magFilter=ve;let a={poses:{value:o},palette:{value:null},axis:{value:t},middle:{value:e},share:{value:0},size:{value:n},...s&&{edge:{value:s.at},right:{value:s.right},up:{value:s.up},section:{value:new Bt(Ap)}}},l=d=>new Wn({glslVersion:di,vertexShader:e1,fragmentShader:n1,uniforms:a,...d}),[c,h,u]=[{},{transparent:!0,depthWrite:!1},{defines:{CUT:""}}].map(l);return[c,h,u,l({defines:{CUT:""},fragmentShader:i1,side:Be})]}function Zm([,i],t){t!=="CUT"in i.defines&&(i.defines=t?{CUT:""}:{},i.needsUpdate=!0)}var zu=256,lc=class{constructor(){this.looks=[]}slot(t,e,n=!1){return this.looks.push({colour:new Bt(t),gloss:e,opened:n,opacity:1,shown:!0}),this.dispose(),this.looks.length-1}paint(t,e){Object.assign(this.looks[t],e),this.stale=!0}refresh(){let t=Math.max(1,Math.ceil(2*this.looks.length/zu));if(!this.texture)this.texture=new Ei(new Uint8Array(4*zu*t),zu,t,Ke,Je),this.texture.minFilter=this.texture.magFilter=ve;else if(!this.stale)return this.texture;let{data:e}=this.texture.image;return this.looks.forEach(({colour:n,gloss:s,opened:r,opacity:o},a)=>{let[l,c,h]=[n.r,n.g,n.b].map(u=>255*Math.sqrt(u));e.set([l,c,h,255*o,255*s,255*r],8*a)}),this.texture.needsUpdate=!0,this.stale=!1,this.texture}dispose(){this.texture?.dispose(),this.texture=void 0}};var s1=`
precision highp float;
uniform mat4 viewMatrix, projectionMatrix;
uniform float unit; // pixels of a spark at its brightest
in vec3 position;
in vec2 look; // brightness of a blow; 1 where teeth are apart
out vec2 seen;
void main() {
  seen = look;
  gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
  gl_PointSize = max(look.x, look.y) > 0.01 ? unit : 0.0;
}`,r1=`
precision highp float;
in vec2 seen;
uniform vec3 apart;
out vec4 colour;
void main() {
  float off = 2.0 * length(gl_PointCoord - 0.5);
  float reach = 0.35 + 0.65 * seen.x;
  float core = sqrt(seen.x) * smoothstep(0.42 * reach, 0.1 * reach, off);
  float halo = sqrt(seen.x) * 0.75 * pow(max(0.0, 1.0 - off / reach), 1.5);
  float ring = 0.9 * seen.y * smoothstep(0.06, 0.02, abs(off - 0.3));
  vec3 blow = mix(vec3(1.0, 0.32, 0.02), vec3(1.0, 0.93, 0.6), core);
  float blaze = max(core, halo);
  float whole = max(blaze, ring);
  if (whole < 0.02) discard;
  colour = vec4(blaze > ring ? blow : apart, whole);
}`,cc=class{constructor(t,e,n){Object.assign(this,{poses:e,run:n}),this.places=t.run.contacts.map(({body:r,at:o})=>({body:r,at:H(o),lift:e.lift(r,H(o))}));let s=this.places.length;this.geometry=new tn,this.geometry.setAttribute("position",new Te(new Float32Array(3*s),3)),this.geometry.setAttribute("look",new Te(new Float32Array(2*s),2)),this.material=new Wn({glslVersion:di,vertexShader:s1,fragmentShader:r1,uniforms:{unit:{value:64},apart:{value:new Bt(nn[0]).convertLinearToSRGB()}},transparent:!0,depthTest:!1,depthWrite:!1}),this.points=Object.assign(new _r(this.geometry,this.material),{frustumCulled:!1,renderOrder:9,matrixAutoUpdate:!1})}set(t){let{position:e,look:n}=this.geometry.attributes;this.places.forEach(({body:s,at:r,lift:o},a)=>{let l=this.poses.apart(r,o).applyMatrix4(this.poses.nodes[s].matrixWorld);e.setXYZ(a,l.x,l.y,l.z),n.setXY(a,this.run.flash(a,t),this.run.state(a,t)==="a"?1:0)}),e.needsUpdate=n.needsUpdate=!0}scale(t){let e=Math.min(1,Math.max(.5,Math.sqrt(12/this.places.length)));this.material.uniforms.unit.value=e*Math.min(160,Math.max(48,.14*t))}dispose(){this.geometry.dispose(),this.material.dispose()}};var o1=(i,t)=>Math.round(Math.min(84,Math.max(18,125*Math.sqrt(i/t))));function Gu(i,t,e){let[n,s]=[i-Math.max(1.3*e,.09*i),Math.max(1.9*t,.09*i)];return n<2.1*s?{rim:.9*t,boss:0}:{rim:n,boss:s}}function Jm(i,t,{rim:e,boss:n}){let[s,r]=[new Gt,t/2];if(!n)return s;ee(s,ye(0,n,-1.15*r,1.15*r),18);let o=e<5*n?4:e<9*n?5:6,a=Math.max(.42*n,.03*i);for(let l=0;l<o;l+=1)a1(s,2*Math.PI*l/o,.9*n,1.005*e,a,.78*r);return s}function a1(i,t,e,n,s,r){let[o,a]=[Math.cos(t),Math.sin(t)],c=[[0,1.75],[.07,1.25],[.18,1],[.8,.72],[.93,.95],[1,1.5]].map(([h,u])=>[e+h*(n-e),u*s]);wn(i,c,-r,r,([h,u,d])=>[h*o-u*a,h*a+u*o,d])}function Km(i,t,e,n){let s=e/2;return ee(new Gt,[[i,-s],[t,-s],[t,s],[i,s]],o1(t,n))}function Vu(i,t,e,n,s){let[r,o]=[0,1].map(c=>i(t,0,c)),a=Math.min(r[2]*e,o[2]*e)-.35*n,l=.5*s;return ee(new Gt,[[l,e*a],[r[0],e*a],[r[0],r[2]],[o[0],o[2]],[l,o[2]]],72)}function jm(i,t,e){let[n,s,r]=[new Gt,.16*t,t/2];return ee(n,ye(0,i,-r,s-r),48),ee(n,ye(0,i,r-s,r),48),ee(n,ye(0,e,-r,r),24)}function Qm(i,t,e){let n=Math.abs(t)/Math.max(1,i.teeth),s=i.radius-.5*n,r=ee(new Gt,ye(0,Math.max(s,.3*i.radius),-e/2,e/2),32);for(let o=0;o<i.teeth;o+=1)l1(r,i.radius,n,t,e,2*Math.PI*o/i.teeth);return r}function l1(i,t,e,n,s,r){let o=[[-.55,-.36],[.32,-.13],[.32,.13],[-.55,.36]],a=Math.ceil(s/Math.abs(n)*32)+4,l=Math.sqrt(.87**2+.23**2);[[.23/l,-.87/l],[1,0],[.23/l,.87/l]].forEach(([h,u],d)=>{let f=i.corners;for(let m=0;m<=a;m+=1){let x=s*(m/a-.5),p=r+2*Math.PI*x/n,[g,S]=[Math.cos(p),Math.sin(p)],w=Math.min(1,(s/2-Math.abs(x))/(.7*e));for(let[b,C]of[o[d],o[d+1]]){let A=t+(w*(b+.55)-.55)*e;i.corner([A*g,A*S,Math.max(-s/2,Math.min(s/2,x+C*e))],[h*g,h*S,u],[-S,g,0])}}for(let m=0;m<a;m+=1)i.indices.push(...[0,1,2,1,3,2].map(x=>f+2*m+x))})}var Hu=2*Math.PI,tg=.02,c1=72,ig=.02;function sg(i,t){let{radius:e,thickness:n,cone:s,helix:r,teeth:o}=i;if(!s){let f=n*Math.tan(r)/e;return(m,x,p)=>{let g=x+(p-.5)*f;return[m*e*Math.cos(g),m*e*Math.sin(g),(p-.5)*n]}}let a=s>Math.PI/2-1e-6,l=a?0:t*e/Math.tan(s),c=e/Math.sin(s),h=Math.PI/o,u=Math.sqrt(n/e),d=1-Math.min(.45,n/c);return(f,m,x)=>{let p=(f-1)*e,g=x?d:1,S=h-Math.abs(m)+u-Math.sin(u)+(1-g)*u/2,w=a?Math.sign(m)*Math.max(0,h-S/g):m,b=(e+p*Math.cos(s))*g,C=l+(t*p*Math.sin(s)-l)*g;return[b*Math.cos(w),b*Math.sin(w),C]}}function rg(i,t,e,n=ig,{hand:s=1,walled:r=null}={}){let a=t>Math.max(...i.map(([p])=>p))?-1:1,l=lg(i,n,a),c=a*s,h=ag(new Gt,l,e,c),u=qu(l[0][1],l.at(-1)[1]),d=r&&r*Math.hypot(...h1(e(1,0,1),e(1,0,0)))/Math.hypot(...e(1,0,.5)),f=[...u.map(p=>[t-d,p]).reverse(),...l],m=Ai.triangulateShape(f.map(([p,g])=>new Dt(p*Math.cos(g),p*Math.sin(g))),[]);for(let p of[0,1]){let g=h.corners,S=Wu([f[u.length-1],f[0],f.at(-1),f[u.length]].map(([w,b])=>e(w,b,p)),p?-c:c);for(let[w,b]of f)h.corner(e(w,b,p),S,eg(b));for(let[w,b,C]of m)h.indices.push(g+w,g+b,g+C)}if(r===null)return h;let x=d?[[t-d,0],[t,r],[t,1-r],[t-d,1]]:[[t,0],[t,1]];for(let p=1;p<x.length;p+=1)for(let g=1;g<u.length;g+=1){let[S,[w,b]]=[[u[g-1],u[g]],[x[p-1],x[p]]],C=[...S.map(A=>e(w[0],A,w[1])),...S.toReversed().map(A=>e(b[0],A,b[1]))];h.face(C,Wu(C,-c),[...S,...S.toReversed()].map(eg))}return h}function qu(i,t){let e=Math.max(1,Math.ceil(c1*(t-i)/Hu-1e-6));return Array.from({length:e+1},(n,s)=>i+s/e*(t-i))}var eg=i=>[-Math.sin(i),Math.cos(i),0],h1=(i,t)=>i.map((e,n)=>e-t[n]);function og(i,t){let e=(r,o,a)=>t(r,o,a?1+tg:-tg),n=lg([...i,i[0]]),s=ag(new Gt,n,e);for(let r of[0,1])s.face(n.slice(1).map(([o,a])=>e(o,a,r)),[0,0,r?1:-1],[1,0,0]);return s}function ag(i,t,e,n=1){let s=t.slice(1).map(([o,a],l)=>{let[c,h]=t[l],u=[e(c,h,0),e(o,a,0),e(o,a,1),e(c,h,1)];return{corners:u,normal:Wu(u,n)}}),r=(o,a)=>a&&u1(o,a)>.87?hc([0,1,2].map(l=>o[l]+a[l])):o;return s.forEach(({corners:o,normal:a},l)=>{let[c,h]=[r(a,s[l-1]?.normal),r(a,s[l+1]?.normal)],u=i.corners,d=hc([0,1,2].map(f=>o[3][f]-o[0][f]));o.forEach((f,m)=>i.corner(f,m===0||m===3?c:h,d)),i.indices.push(u,u+1,u+2,u,u+2,u+3)}),i}var u1=(i,t)=>i[0]*t[0]+i[1]*t[1]+i[2]*t[2],hc=i=>{let t=Math.hypot(...i)||1;return i.map(e=>e/t)};function Wu([i,t,e,n],s=1){let[r,o]=[[0,1,2].map(a=>e[a]-i[a]),[0,1,2].map(a=>n[a]-t[a])];return hc([r[1]*o[2]-r[2]*o[1],r[2]*o[0]-r[0]*o[2],r[0]*o[1]-r[1]*o[0]].map(a=>s*a))}function lg(i,t=ig,e=1){let n=i.map(([h])=>h),s=t*(Math.max(...n)-Math.min(...n)),r=i.map(([h,u])=>[h*Math.cos(u),h*Math.sin(u)]),o=Xu(r,s).map(([h,u])=>d1(r,h,u,e)),a=(h,u)=>({from:h,to:h,way:[Math.cos(u),Math.sin(u)],in:[0,0]}),l=[a(r[0],i[0][1]),...o,a(r.at(-1),i.at(-1)[1])],c=i[0][1];return l.slice(1).flatMap((h,u)=>f1(l[u],h,s).map(([d,f])=>{let m=Math.atan2(f,d);return c=m+Hu*Math.round((c-m)/Hu),[Math.hypot(d,f),c]}))}function Xu(i,t,e=0,n=i.length-1){let[s,r]=[t,-1];for(let o=e+1;o<n;o+=1){let a=p1(i[o],i[e],i[n]);a>s&&([s,r]=[a,o])}return r<0?[[e,n]]:[...Xu(i,t,e,r),...Xu(i,t,r,n)]}function d1(i,t,e,n){let[s,r]=[i[t],i[e]],o=hc([r[0]-s[0],r[1]-s[1]]),a=[-n*o[1],n*o[0]],l=h=>(h[0]-s[0])*a[0]+(h[1]-s[1])*a[1],c=Math.max(0,...i.slice(t+1,e).map(l));return{from:s,to:r,way:o,in:a.map(h=>h*c)}}function f1(i,t,e){let[n,s]=[i.to,t.from].map((a,l)=>ng(a,[i,t][l].in)),r=i.way[0]*t.way[1]-i.way[1]*t.way[0],o=((s[0]-n[0])*t.way[1]-(s[1]-n[1])*t.way[0])/r;return Math.abs(o)<=4*e?[ng(n,i.way.map(a=>a*o))]:Math.hypot(s[0]-n[0],s[1]-n[1])>1e-9?[n,s]:[n]}var ng=(i,t)=>i.map((e,n)=>e+t[n]);function p1([i,t],[e,n],[s,r]){let[o,a]=[s-e,r-n],l=Math.hypot(o,a);return l<1e-12?Math.hypot(i-e,t-n):Math.abs(o*(t-n)-a*(i-e))/l}var m1=2e3,g1=12e3,_1=5e-4,x1=.75,v1=.1,uc=class{constructor(t,e,n,s,r){let o=t.wheels[e];Object.assign(this,{scene:t,index:e,wheel:o,size:s,palette:r}),this.at=H(o.centre),this.matrix=$t(o.centre,o.direction,o.reference,o.turn),[this.own,this.toothed,this.smooth]=[0,1,2].map(()=>r.slot("#ffffff",x1,o.kind==="ring")),this.profile=t.profiles[o.profile],this.apex=-o.facing||1,this.surface=sg(y1(t,e),this.apex);let a=this.profile.points.map(([c])=>c),l=o.kind==="ring";this.wave=t.waves.find(c=>c.wheel===e),this.root=l?Math.max(...a):Math.min(...a),this.crest=Math.max(...a),this.depth=(Math.max(...a)-Math.min(...a))*o.radius,this.hub=Math.min(n,.4*Math.abs(this.root)*o.radius)}get slots(){return[this.own,this.toothed,this.smooth]}get seat(){let{wheel:t,root:e,hub:n,depth:s,wave:r}=this,o=e*t.radius;return t.kind==="ring"?Vr(t):r?o-r.wall:t.holes.length?(1-Math.min(.03,.1*e))*o:Gu(o,n,s).rim}castBody(t){let{wheel:e,root:n,hub:s,size:r,depth:o,seat:a}=this,{kind:l,radius:c,thickness:h,cone:u,holes:d}=e;if(l==="worm")return t(this.worm(),this.matrix,this.own);if(this.profile.hole)return t(jm(this.crest*1.08*c,h,s),this.matrix,this.own);if(u)return t(Vu(this.surface,n-.01,this.apex,h,s),this.matrix,this.toothed),t(Vu(this.surface,1,this.apex,h,s),this.matrix,this.smooth);d.length?t(Ou({outlines:[this.edge(),...d],height:h},1),this.matrix,this.own):l!=="ring"&&!this.wave&&t(Jm(n*c,h,Gu(n*c,s,o)),this.matrix,this.own),t(Km(Math.min(a,c),Math.max(a,c),.96*h,r),this.matrix,this.smooth)}castTeeth(t,e){let{wheel:n,profile:s,surface:r,root:o,apex:a,seat:l}=this;if(n.kind==="worm")return;let c=e>g1?.3:Math.min(.3,Math.max(.02,_1*this.size/this.depth)),h=n.cone?o-Math.min(.03,.1*o):l/n.radius,u=n.cone||n.holes.length?null:n.kind==="ring"?v1:0,d=s.hole?og(s.points,r):rg(s.points,h,r,c,{hand:n.cone?a:1,walled:u});t(d,this.matrix,s.hole?this.own:this.toothed,Math.min(n.teeth,m1))}edge(){let t=Math.PI/this.wheel.teeth;return Array.from({length:this.wheel.teeth},(n,s)=>qu((2*s-1)*t,(2*s+1)*t).slice(1)).flat().flatMap(n=>[this.seat*Math.cos(n),this.seat*Math.sin(n)])}worm(){let{lead:t,length:e}=hg(this.scene,this.index);return Qm(this.wheel,t,e)}paint(t){for(let e of this.slots)this.palette.paint(e,t)}show(t,e){this.palette.paint(this.own,{shown:t}),this.palette.paint(this.toothed,{shown:t&&e}),this.palette.paint(this.smooth,{shown:t&&!e})}},cg=(i,t)=>i.pairs.filter(({wheels:e})=>e.includes(t)).map(({wheels:[e,n]})=>e===t?n:e);function y1(i,t){let e=cg(i,t).find(n=>i.wheels[n].kind==="worm");return e===void 0?i.wheels[t]:{...i.wheels[t],helix:Math.atan(hg(i,e).lead/(2*Math.PI*i.wheels[e].radius))}}function hg(i,t){let e=i.wheels[t],n=cg(i,t).map(h=>i.wheels[h])[0];if(!n)return{lead:e.radius,length:e.thickness};let s=e.teeth*2*Math.PI*n.radius/n.teeth,[r,o]=[e,n].map(({body:h})=>Math.sign(Number.parseFloat(i.bodies[h].speed??"0"))*i.bodies[h].sense),a=H(e.centre).sub(H(n.centre));return{lead:(H(n.direction).cross(a).dot(H(e.direction))*o*r>0?-1:1)*s,length:Math.max(e.thickness,Math.min(3*Math.abs(s),n.radius))}}var ug=.12,M1=["frame","dial","foot"],b1=1.1,oo=class{constructor(t){this.scene=t.scene;let e=Qi(this.scene);this.main=ul(this.scene),this.corners=Uu([...this.scene.parts,...this.scene.shapes],this.main);let n=this.corners.map(({point:s})=>s);this.ball=ll(this.scene,e,n),this.size=2*this.ball.radius,this.poses=new Gs(t,this.main,this.ball.center,hl(this.scene,[...e.flatMap(On),...n],this.main)),this.root=this.poses.root,this.nodes=this.poses.nodes,this.palette=new lc,this.quarter=Rm(this.scene,this.size),this.materials=Ym(this.nodes.length,this.main,this.ball.center,this.size,this.quarter),this.uniforms=this.materials[0].uniforms,this.castings=[new Zs,new Zs,new Zs],this.parts=[],this.build(),this.bends=this.scene.waves.map(s=>this.bendOf(t,s)),this.sight=new sc(this.scene),this.looks=new Fs(this.scene,this.palette,this.wheels,this.parts,this.sight),this.looks.showTeeth(!1),this.looks.paint("plain"),this.root.add(...this.cast(0),...this.cast(2)),this.machine=t,this.ground=new ac(this.size,this.scene.up),this.root.add(this.ground.mesh),t.simulated&&(this.sparks=new cc(t.scene,this.poses,t.run),this.root.add(this.sparks.points)),this.explode(0)}build(){let{scene:t,size:e,palette:n}=this,s=km(t),r=zm(t,s,e),o=Um(t,this.main),a=t.bodies.map((h,u)=>so(t,u)),l=h=>{let u=Me(t.bodies[h.body],h.centre),d=a[h.body].find(([f,m])=>f<=u&&u<=m);return d?d[2]:r[h.body]};this.wheels=t.wheels.map((h,u)=>new uc(t,u,l(h),e,n));for(let h of this.wheels)h.castBody(this.adder(this.castings[0],h));for(let h of o.length?o:Gm(t,s,r,e))this.put(h);for(let h of Fm(t,this.main))this.put(h);let c=new Set(t.parts.map(({name:h})=>h));for(let h of t.couplings)!c.has(`${h.id} pin`)&&!c.has(`${h.id} pin 1`)&&Hm(t,h,e).forEach(u=>this.put(u));t.dials.forEach((h,u)=>Np(t,u).forEach(d=>this.put(d))),t.pointers.forEach(({dial:h},u)=>{if(h===null||qr(t,u)!==u)return;let d=t.dials[h].look==="ball"?this.poses.ball(h):t.pointers[u].body;Up(t,u,Bs(t,u)).forEach(f=>this.put({...f,body:f.slides===void 0?d:this.poses.slide(u)}))}),t.hangers.forEach((h,u)=>{let d=this.poses.hanger(u),f=qm(h,b1*e);$m({...h,parts:f}).forEach(m=>this.put({...m,body:d})),this.corners.push(...Uu(f,this.main).map(m=>({...m,body:d})))}),this.crank=this.buildCrank(s),this.crank?.parts.forEach(h=>this.put(h))}bendOf(t,e){let n=this.wheels[e.wheel],{body:s,thickness:r}=n.wheel,o=c=>c.distanceTo(n.at),l=this.parts.filter(({wall:c})=>c&&Zn(this.scene.bodies[s],c[0])<1e-6*this.size).map(({slot:c,wall:h})=>({slot:c,ends:h.toSorted((u,d)=>o(u)-o(d))})).filter(({ends:[c]})=>o(c)<r);return new oc(t,e,n,l.map(({slot:c,ends:h})=>({slot:c,bottom:h[1]})))}get isDriven(){let{crank:t,drive:e,hangers:n,shapes:s}=this.scene;return e==="weight"&&n.some(({kind:r})=>r==="weight")||s.some(({kind:r,body:o})=>r==="road"&&o===t)}buildCrank(t){let{scene:e,size:n}=this;if(e.crank===null||e.bodies[e.crank].parent===null||this.isDriven)return null;let s=e.bodies[e.crank],o=e.bodies.map((_,T)=>T).filter(_=>t[_]&&ol(e,e.crank,_,n)).flatMap(_=>t[_].map(T=>Me(s,be(e.bodies[_],T)))),a=t[e.crank]??[0,0],[l,c]=[Math.min(...o,...a),Math.max(...o,...a)],h=[a[0]-l,c-a[1]],u=_=>be(s,_).distanceTo(this.ball.center),f=e.drive==="motor"&&he(s.direction,this.main.toArray())?-H(s.direction).dot(this.main)*e.front:Math.abs(h[0]-h[1])>1e-6*n?h[0]-h[1]:he(s.direction,this.main.toArray())?H(s.direction).dot(this.main)*e.front:u(c)-u(l),m=({centre:_,normal:T,radius:F})=>he(s.direction,T)&&Zn(s,_)<1.08*F+ug*n,x=new Set(e.dials.filter(m).map(({normal:_})=>Math.sign(H(_).dot(H(s.direction))))),p=x.size===1?-[...x][0]:f<0?-1:1,g=p>0?c:l,S=g+p*.02*n,w=a[p>0?1:0],b=so(e,e.crank).sort((_,T)=>p*(T[0]-_[0]))[0],C=e.drive==="motor"||e.drive==="spring"?Xm(e,e.crank,S,p,n):Wm(e,e.crank,S,p,ug*n,n);C.at=be(s,g);for(let _ of C.parts)_.at=C.at;let A=(_,T,F)=>({body:e.crank,colour:Tt.arbor,...rc(be(s,_),be(s,T),b?b[2]:.009*n),at:F});return C.parts.push(A(w-p*.01*n,g,null),A(g-p*.005*n,S,C.at)),C}put({colour:t,gloss:e=.85,shape:n,matrix:s,body:r,at:o,dial:a,plate:l,cover:c,pane:h,bar:u,wall:d,opened:f}){let m=this.palette.slot(t,e,f);this.castings[c||u?2:0].add(n,s,{body:r,slot:m,lift:this.poses.lift(r,o)}),this.parts.push({slot:m,body:r,at:o,dial:a,plate:l,cover:c,pane:h,bar:u,wall:d,colour:t})}adder(t,{wheel:{body:e},at:n}){return(s,r,o,a)=>t.add(s,r,{body:e,slot:o,count:a,lift:this.poses.lift(e,n)})}cast(t){return this.arranged=!1,this.castings[t].cast(this.materials)}castTeeth(){let t=this.scene.wheels.reduce((e,{teeth:n})=>e+n,0);for(let e of this.wheels)e.castTeeth(this.adder(this.castings[1],e),t);this.root.add(...this.cast(1)),this.bend(),this.cut=!0}turn(){let{value:t}=this.uniforms.poses;this.poses.turn(t.image.data),t.needsUpdate=!0,this.bend(),this.sparks?.set(this.machine.time())}bend(){for(let t of this.bends)t.turn(this.castings)}cutOpen(t){this.opened=t&&!!this.quarter,this.arranged=!1,Zm(this.materials,this.opened)}explode(t){this.uniforms.share.value=t,this.poses.explode(t),this.turn(),this.ground.fit(this.outline())}outline(t=null){let e=t&&this.scene.dials.some(({placed:c})=>c),{crank:n,poses:s}=this,r=n?On({at:n.end,direction:this.scene.bodies[n.body].direction,radius:1.17*n.reach}):[],o=(c,h,u)=>{let d=s.lift(h,u);return s.apart(c,typeof d=="number"?d:d(c)).add(s.shifts[h])},a=c=>s.bodies[c].hangs!==void 0,l=this.corners.filter(({kind:c})=>!(e&&M1.includes(c))).map(({point:c,body:h,at:u})=>a(h)?this.placed(c,h,u??c):o(c,h,u));return[...cl(this.scene,s,e&&t),...r.map(c=>o(c,n.body,n.at)),...l]}ofCrank(t){return this.placed(t,this.crank.body,this.crank.at)}placed(t,e,n=t){return this.poses.apart(t,this.poses.lift(e,n)).applyMatrix4(this.nodes[e].matrixWorld)}pick(t){let e=this.nodes.map(()=>null),n=h=>e[h]??=t.clone().applyMatrix4(this.nodes[h].matrixWorld.clone().invert()),s=h=>this.main.clone().multiplyScalar(this.poses.share*h),r=new Set(this.looks.glass?.map(h=>h.slot)),o=(h,u)=>this.opened&&this.palette.looks[h].opened&&Pm(this.quarter,t.at(u,H([0,0,0]))),[a,l]=[1/0,null];for(let h of this.castings)for(let[u,d]of h.met(n,s))u<a&&this.palette.looks[d.slot].shown&&!r.has(d.slot)&&!o(d.slot,u)&&([a,l]=[u,d.slot]);let c=this.wheels.findIndex(h=>h.slots.includes(l));return c<0?null:c}glaze(t){this.looks.glaze(t,this.ball.center)}refresh(){if(!(!this.palette.stale&&this.arranged)){this.uniforms.palette.value=this.palette.refresh();for(let t of this.castings)t.meshes&&t.distribute(e=>this.meshOf(this.palette.looks[e]));this.arranged=!0}}meshOf({shown:t,opacity:e,opened:n}){return t?e<1?1:n&&this.opened?2:0:-1}dispose(){for(let t of this.castings)t.dispose();this.sparks?.dispose(),this.ground.dispose(),this.palette.dispose(),this.uniforms.poses.value.dispose();for(let t of this.materials)t.dispose()}};var $u=Math.PI/180,dg=26,Js={front:[0,0,1],back:[0,0,-1],side:[1,0,0],free:[.36,.3,.88]},S1=[17,38,58,4].flatMap(i=>[25,-25,0,55,-55].map(t=>[i*$u,t*$u])).map(([i,t])=>[Math.sin(t)*Math.cos(i),Math.sin(i),Math.cos(t)*Math.cos(i)]),w1=1.13,T1=.95,dc=[.62,.46,.64],E1=[dc[0],dc[1],-dc[2]],A1=[Js.free[0],Js.free[1],-Js.free[2]],C1=1.05,R1=1.7,P1=.02,I1=1200,L1=.55,fc=class{constructor(t,e,n={}){this.canvas=t,this.machine=e,this.onPick=()=>{},this.onCrank=()=>{},this.onOrbit=()=>{},this.onDraw=()=>{},this.renderer=new il({canvas:t,antialias:!0,alpha:!1,stencil:!1}),this.renderer.debug.checkShaderErrors=!1,this.world=new oo(e),this.world.cutOpen(n.cutaway??!!this.world.quarter?.hides),this.toothed=n.teeth!==!1,this.setting=new pr,this.setting.matrixAutoUpdate=!1,this.setting.add(this.world.root),this.camera=new $e(dg,1,.02*this.world.size,60*this.world.size),this.camera.up.set(...e.scene.up),this.controls=new nc(this.camera,t),this.controls.minDistance=.1*this.world.size,this.controls.maxDistance=30*this.world.size,this.controls.addEventListener("change",()=>this.request()),this.controls.addEventListener("start",()=>this.orbiting=!0),this.controls.addEventListener("change",()=>this.orbited()),this.controls.addEventListener("end",()=>this.orbiting=!1),this.hands=new ic(this),this.theme({background:n.background??"#f4f1ea"}),this.observer=new ResizeObserver(()=>this.resize()),this.observer.observe(t),this.look("free"),this.resize()}setTurns(t){this.machine.turns=nt.of(t),this.turned=!0,this.request()}paint(t,e){this.change(()=>this.world.looks.paint(t,e))}highlight(t,e){this.change(()=>this.world.looks.highlight(t,e))}select(t){this.change(()=>this.world.looks.select(t))}explode(t){let e=this.framed();if(this.change(()=>this.world.explode(Math.min(1,Math.max(0,t)))),!this.width)return;if(this.from==="free"){this.look("free");return}let n=this.framed(e.towards),{position:s}=this.camera,r=s.clone().sub(this.controls.target).multiplyScalar(n.distance/e.distance);this.controls.target.add(n.target).sub(e.target),s.copy(this.controls.target).add(r),this.controls.update()}hideFront(t){let{main:e}=this.world,n=e.clone().multiplyScalar(this.machine.scene.front*Math.sign(e.z||1));this.change(()=>this.world.looks.hideBefore(t?n:null))}showTeeth(t){this.toothed=t,t&&this.whole&&!this.world.cut&&this.world.castTeeth(),this.change(()=>this.world.looks.showTeeth(t&&!!this.world.cut))}get canOpen(){return!!this.world.quarter}cutOpen(t){this.change(()=>this.world.cutOpen(t)),this.from==="free"&&this.look("free")}cut(){this.disposed||(this.whole=!0,this.showTeeth(this.toothed))}theme({background:t}){this.change(()=>this.renderer.setClearColor(new Bt(t)))}change(t){t(),this.request()}rebuild(t){if(this.disposed)return;let{opened:e,poses:{share:n}}=this.world,{chosen:s,selected:r}=this.world.looks;this.setting.remove(this.world.root),this.world.dispose(),this.machine=t,this.world=new oo(t),this.setting.add(this.world.root),this.world.explode(n),this.world.cutOpen(e),this.showTeeth(this.toothed),Object.assign(this.world.looks,{chosen:s,selected:r}),this.turned=!0,this.request()}visit(t,e,n){let{points:s,towards:r=null,chosen:o=null}=t?vm(this.world,t):{points:this.world.outline()};this.highlight(o,e);let a=r??this.nearer(s),{target:l,distance:c}=Ru(s,a,...this.slopes),h=this.framed(a).distance;this.from=null,this.onOrbit(),this.fly(l,l.clone().addScaledVector(a,t?Math.min(R1*c,h):h),n?0:I1)}nearer(t){let{main:e,ball:n,size:s}=this.world,r=this.opening().clone(),o=t.reduce((l,c)=>l+c.clone().sub(n.center).dot(e),0)/t.length,a=r.dot(e);return o*a<-P1*s?r.addScaledVector(e,-2*a):r}fly(t,e,n){let{camera:s,controls:r}=this,[o,a,l,c]=[r.target.clone(),s.position.clone(),performance.now(),this.flight={}],h=u=>{if(this.flight!==c||this.disposed||this.orbiting)return;let d=n?Math.min(1,Math.max(0,u-l)/n):1,f=d*d*(3-2*d);r.target.lerpVectors(o,t,f),s.position.lerpVectors(a,e,f),r.update(),this.request(),d<1&&requestAnimationFrame(h)};h(l)}look(t){let e=t in Js&&t!=="free";this.from=t,e?this.fit(this.towards(Js[t])):this.fit(this.aside(this.opening()))}towards([t,e,n]){let{front:s=1,up:r}=this.machine.scene;return r[2]&&(t||e)?H([t*s,-n,e*s]).normalize():H([t*s,e,n*s]).normalize()}opening(){let{aspect:t}=this.camera,{opened:e}=this.world,[n,s]=e?[[E1],dc]:[this.machine.scene.waves.length?[A1]:S1,Js.free];return(this.found?.aspect!==t||this.found.opened!==e)&&(this.found={aspect:t,opened:e,towards:this.bestOf(n.map(r=>this.towards(r)),this.towards(s))}),this.found.towards}bestOf(t,e){if(this.machine.scene.dials.length)return e;let n=o=>{let{target:a,distance:l}=this.framed(o);return this.world.sight.seen(a.addScaledVector(o,l))},s=t.map(o=>({towards:o,share:n(o)})),r=Math.max(...s.map(({share:o})=>o));return r>w1*n(e)?s.find(({share:o})=>o>T1*r).towards:e}aside(t){let{main:e,poses:n}=this.world,s=t.dot(e),r=Math.min(Math.abs(s),L1),o=Math.sign(s)*(Math.abs(s)+n.share*(r-Math.abs(s)));return t.clone().addScaledVector(e,-s).normalize().multiplyScalar(Math.sqrt(1-o*o)).addScaledVector(e,o)}fit(t){this.flight=null;let{target:e,distance:n}=this.framed(t);this.controls.target.copy(e),this.camera.position.copy(e).addScaledVector(t,n),this.controls.update(),this.request()}framed(t=this.camera.position.clone().sub(this.controls.target).normalize()){return{towards:t,...Ru(this.world.outline(this.from==="free"?t:null),t,...this.slopes)}}get slopes(){let t=Math.tan(dg*$u/2)/C1;return[this.machine.scene.up,t*this.camera.aspect,t]}orbited(){!this.orbiting||this.from===null||(this.from=null,this.onOrbit())}resize(){let{clientWidth:t,clientHeight:e}=this.canvas;if(!t||!e||this.disposed)return;let n=Math.min(globalThis.devicePixelRatio||1,2);this.width===t&&this.height===e&&this.density===n||(Object.assign(this,{width:t,height:e,density:n}),this.renderer.setPixelRatio(n),this.renderer.setSize(t,e,!1),this.world.sparks?.scale(n*Math.min(t,e)),this.camera.aspect=t/e,this.camera.updateProjectionMatrix(),this.from!==null&&this.look(this.from),this.render())}request(){this.waiting||this.disposed||(this.waiting=requestAnimationFrame(()=>this.render()))}render(){cancelAnimationFrame(this.waiting),this.waiting=0,!(!this.width||this.disposed)&&(this.turned&&this.world.turn(),this.turned=!1,this.world.glaze(this.camera.position),this.world.refresh(),this.renderer.render(this.setting,this.camera),this.onDraw())}leadOf(t){let{bodies:e,crank:n}=this.machine.scene,s=e[n],r=e[s.parent],o=l=>l.sense*Number(nt.of(l.speed??"0")),a=o(s)-o(r);return a?t/(2*Math.PI*a):0}dispose(){this.disposed=!0,cancelAnimationFrame(this.waiting),this.observer.disconnect(),this.hands.dispose(),this.controls.dispose(),this.world.dispose(),this.renderer.dispose(),this.renderer.forceContextLoss()}};var gg=document.getElementById("scenes"),D1=Uint8Array.from(atob(gg.textContent),i=>i.charCodeAt(0)),{scenes:Yu,options:Zu}=JSON.parse(gd(md(D1)));Yu.unshift(...Yu.splice(Number(gg.dataset.first??0),1));var is=Yu.flatMap(i=>i.run?[i,{...i,touching:!0}]:[i]),Fi=is.map(i=>new _i(i)),Oe={scenes:is,machines:Fi,options:Zu,stages:is.map(()=>null),gears:is.map(()=>nt.of(1)),turns:0,onTurns:null,setTurns(i){let t=nt.of(i);Oe.turns=i,Fi.forEach((e,n)=>e.turns=t.times(Oe.gears[n])),Oe.stages.forEach((e,n)=>e?.setTurns(Fi[n].turns)),Oe.onTurns?.(i)},open(i){try{Oe.stages[i]=new fc(document.createElement("canvas"),Fi[i],Zu)}catch(t){console.warn(`3D graphics are not available: ${t.message}`),Oe.stages[i]=new Ml(Fi[i])}return Oe.stages[i]},close(i){Oe.stages[i]?.dispose(),Oe.stages[i]=null}};function fg(i,t,e){let n=i.findIndex(s=>s[t]===e);if(n<0)throw new RangeError(`unknown name "${e}"`);return n}globalThis.geartrain={scenes:is,machines:Fi,stages:Oe.stages,setTurns:Oe.setTurns,get turns(){return Oe.turns},angle:(i,t)=>Fi[i].angle(fg(is[i].bodies,"id",t)),pointer:(i,t)=>Fi[i].pointer(fg(is[i].pointers,"output",t)),ready:!1};var pg=()=>new Promise(i=>{requestAnimationFrame(()=>setTimeout(i)),setTimeout(i,400)});async function N1(i){i(Oe),await pg(),Oe.interface.openStages(),await pg();for(let t of Oe.stages)t?.cut();Oe.interface.begin?.(),globalThis.geartrain.ready=!0}var mg=io.asked(location.hash,Zu.shown);N1(mg?()=>Oe.interface=new io(Oe,mg):Sm);})();
/*! Bundled license information:

three/examples/jsm/libs/fflate.module.js:
  (*!
  fflate - fast JavaScript compression/decompression
  <https://101arrowz.github.io/fflate>
  Licensed under MIT. https://github.com/101arrowz/fflate/blob/master/LICENSE
  version 0.8.3
  *)

three/build/three.core.js:
three/build/three.module.js:
  (**
   * @license
   * Copyright 2010-2026 Three.js Authors
   * SPDX-License-Identifier: MIT
   *)
*/
