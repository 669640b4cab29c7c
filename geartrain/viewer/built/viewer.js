(()=>{var ac=1n<<900n,nt=class i{constructor(t,e=1n){let n=e<0n?-1n:1n,s=tg(t<0n?-t:t,n*e);this.numerator=n*t/s,this.denominator=n*e/s}static of(t){return t instanceof i?t:typeof t=="bigint"?new i(t):typeof t=="number"?jm(t):Qm(String(t))}static parse(t){try{return t==null?null:i.of(t)}catch{return null}}static near(t,e=9){return new i(BigInt(Math.round(t*10**e)),10n**BigInt(e))}plus(t){let{numerator:e,denominator:n}=i.of(t);return new i(this.numerator*n+e*this.denominator,this.denominator*n)}minus(t){let{numerator:e,denominator:n}=i.of(t);return this.plus(new i(-e,n))}times(t){let{numerator:e,denominator:n}=i.of(t);return new i(this.numerator*e,this.denominator*n)}over(t){let{numerator:e,denominator:n}=i.of(t);return new i(this.numerator*n,this.denominator*e)}equals(t){let{numerator:e,denominator:n}=i.of(t);return this.numerator===e&&this.denominator===n}get floor(){let t=this.numerator/this.denominator;return t*this.denominator>this.numerator?t-1n:t}get part(){return lc(this.numerator-this.floor*this.denominator,this.denominator)}valueOf(){return lc(this.numerator,this.denominator)}toString(){return this.denominator===1n?`${this.numerator}`:`${this.numerator}/${this.denominator}`}};function cc(i,t){let e=i.denominator*t.denominator,n=i.numerator*t.numerator%e;return 2n*n>=e?n-=e:2n*n<-e&&(n+=e),lc(n,e)}function lc(i,t){if(t<ac&&i<ac&&i>-ac)return Number(i)/Number(t);let e=a=>(a<0n?-a:a).toString(16).length*4,n=a=>BigInt(Math.max(0,e(a)-200)),[s,r]=[n(i),n(t)],o=Number(s-r);return Number(i>>s)/Number(t>>r)*2**o}function jm(i){if(!Number.isFinite(i))throw new RangeError(`${i} is not a number of turns`);let t=0;for(;!Number.isInteger(i);)i*=2,t+=1;return new nt(BigInt(i),1n<<BigInt(t))}function Qm(i){let t=/^\s*([+-]?)(\d*)(?:\.(\d*))?(?:e([+-]?\d{1,4}))?(?:\s*\/\s*(\d+))?\s*$/i.exec(i.replace("−","-"));if(!t||!(t[2]||t[3]))throw new RangeError(`"${i}" is not a number`);let[,e,n,s="",r="0",o="1"]=t;if(BigInt(o)===0n)throw new RangeError(`"${i}" divides by zero`);let a=BigInt(r)-BigInt(s.length),l=BigInt(`${n}${s}`)*(e==="-"?-1n:1n),[c,h]=a<0n?[1n,10n**-a]:[10n**a,1n];return new nt(l*c,h*BigInt(o))}function tg(i,t){for(;t;)[i,t]=[t,i%t];return i||1n}var to=class{constructor({period:t,breaks:e,coefficients:n}){this.period=t,this.breaks=Zu(e);let s=this.breaks.length-1;this.coefficients=Zu(n),this.terms=this.coefficients.length/s}at(t){let e=t-Math.floor(t/this.period)*this.period,n=this.cell(e),s=e-(this.breaks[n]+this.breaks[n+1])/2,r=n*this.terms,o=0,a=0;for(let l=this.terms-1;l>=0;l-=1)a=a*s+o,o=o*s+this.coefficients[r+l];return[o,a]}cell(t){let e=0,n=this.breaks.length-1;for(;n-e>1;){let s=e+n>>1;this.breaks[s]<=t?e=s:n=s}return e}};function Ju(i,t,e,n){let s=h=>i.map((u,d)=>u.at(e[d]+hc(n[d],h)).map(f=>t[d]*f)),r=1+Math.max(...e.map(Math.abs))+Math.max(...n.map(h=>hc(h.map(Math.abs),h.map(()=>1)))),o=i.map((h,u)=>t[u]*h.at(e[u])[0]),a=o.map(()=>0),l=1,c=1/0;for(let h=0;h<120;h+=1){let u=o.map((p,g)=>p-l*a[g]),d=s(u),f=u.map((p,g)=>p-d[g][0]),m=Math.max(...f.map(Math.abs));if(m>=c){if(l/=2,l<1e-9)break;continue}if([o,c,l]=[u,m,1],m<=2e-15*r)break;let x=d.map(([,p],g)=>n[g].map((S,w)=>(g===w?1:0)-p*S));a=eg(x,f)}return o}var hc=(i,t)=>i.reduce((e,n,s)=>e+n*t[s],0);function eg(i,t){let e=i.map((s,r)=>[...s,t[r]]);for(let s=0;s<e.length;s+=1){let r=s;for(let o=s+1;o<e.length;o+=1)Math.abs(e[o][s])>Math.abs(e[r][s])&&(r=o);[e[s],e[r]]=[e[r],e[s]];for(let o=s+1;o<e.length;o+=1){let a=e[o][s]/e[s][s];for(let l=s;l<=e.length;l+=1)e[o][l]-=a*e[s][l]}}let n=t.map(()=>0);for(let s=e.length-1;s>=0;s-=1)n[s]=(e[s][e.length]-hc(e[s].slice(0,e.length),n))/e[s][s];return n}function Zu(i){let t=Uint8Array.from(atob(i),e=>e.charCodeAt(0));return new Float64Array(t.buffer)}var eo=class{constructor(t){Object.assign(this,{period:t.period,duration:t.duration,step:t.step}),this.links=t.links.map(({rate:e,samples:n,angles:s})=>({rate:e,samples:Ku(n),angles:ju(s)})),this.contacts=t.contacts.map(e=>({...e,changes:Ku(e.changes),impact_times:ng(e.impact_times),impact_speeds:ju(e.impact_speeds)})),this.hardest=Math.max(0,...this.contacts.map(({hardest:e})=>e)),this.blows=Float64Array.from(this.contacts.flatMap(({impact_times:e})=>[...e])).sort(),this.glow=.35,this.slip=1e-12*Math.max(this.duration,this.period)}turned(t,e){let{rate:n,samples:s,angles:r}=this.links[t],o=Math.min(Math.max(e,0),this.duration),a=o/this.step,l=Math.min(Ui(s,a),s.length-2),c=(a-s[l])/(s[l+1]-s[l]);return n*o+r[l]+c*(r[l+1]-r[l])}state(t,e){let{changes:n,states:s}=this.contacts[t];return s?s[Math.max(0,Ui(n,e/this.step+1e-6))]:""}*stretches(t,e,n){let{changes:s,states:r}=this.contacts[t];for(let o=Math.max(0,Ui(s,e/this.step));o<s.length;o+=1){let a=s[o]*this.step;if(a>n)return;let l=o+1<s.length?s[o+1]*this.step:this.duration;yield[r[o],Math.max(a,e),Math.min(l,n)]}}*blowsOf(t,e,n){let{impact_times:s,impact_speeds:r}=this.contacts[t];for(let o=Ui(s,e)+1;o<s.length&&s[o]<=n;o+=1)yield[s[o],this.strength(r[o])]}strength(t){return .4+.6*Math.sqrt(t/this.hardest)}flash(t,e){let{impact_times:n,impact_speeds:s}=this.contacts[t],r=0;for(let o=Ui(n,e+this.slip);o>=0&&e-n[o]<3*this.glow&&(r=Math.max(r,this.strength(s[o])*Math.exp((n[o]-e)/this.glow)),!(r>.99));o-=1);return r}set pace(t){this.glow=.35*t}blowFrom(t,e){let n=e>0?Ui(this.blows,t+this.slip)+1:Ui(this.blows,t-this.slip);return this.blows[n]??(e>0?this.duration:0)}};function Ui(i,t){let[e,n]=[0,i.length];for(;e<n;){let s=e+n>>1;i[s]<=t?e=s+1:n=s}return e-1}var uc=i=>Uint8Array.from(atob(i),t=>t.charCodeAt(0)).buffer,Ku=i=>new Uint32Array(uc(i)),ju=i=>new Float32Array(uc(i)),ng=i=>new Float64Array(uc(i));var di=2*Math.PI,fi=class{constructor(t){this.scene=t,this.lead=t.driving_link,this.moves=t.movement.kind!=="still"&&t.driving_link!==null,this.step=nt.of(t.step||"1"),this.period=t.movement.period===null?null:nt.of(t.movement.period),this.speeds=t.bodies.map(n=>n.speed===null?null:nt.of(n.speed));let e=t.bodies.map(({id:n})=>n);this.ahead=new no(t.movement,e),this.back=t.back?new no(t.back,e):this.ahead,this.turns=nt.of(0),t.run&&(this.run=new eo(t.run),this.simulated=!t.touching,this.initial=this.ahead.at(this.turns))}time(t=this.turns){return Number(nt.of(t))*this.run.period}made(t=this.turns){return this.run?nt.near(this.run.turned(this.scene.driving_link,this.time(t))/di,14):nt.of(t)}declared(t,e=this.turns){if(this.simulated)return this.scene.bodies[t].start+this.initial[t]+this.run.turned(t,this.time(e));let n=this.speeds[t],s=this.made(e),r=this.scene.bodies[t].travels?(a,l)=>Number(a)*Number(l):cc,o=n?di*r(n,s):0;return this.scene.bodies[t].start+o+this.errors(s)[t]}angle(t,e=this.turns){return this.scene.bodies[t].sense*this.declared(t,e)}joint(t,e=this.turns){let{parent:n,base:s}=this.scene.bodies[t],r=s??n;return this.angle(t,e)-(r===null?0:this.angle(r,e))}errors(t=this.turns){let e=nt.of(t);return(!this.latest||!this.latestTurns.equals(e))&&(this.latest=(e.numerator*this.step.numerator<0n?this.back:this.ahead).at(e),this.latestTurns=e),this.latest}pointer(t,e=this.turns){let{body:n,base:s,dial:r}=this.scene.pointers[t],{mean:o,error:a}=this.simulated?this.played(t,e):this.followed(t,this.made(e)),l=this.scene.bodies,c=o.part*di+l[n].start-l[s].start+a,h=Math.floor(c/di),u=Math.min(Math.max(c-h*di,0),di),d=o.floor+BigInt(h),f=BigInt((r===null?1:this.scene.dials[r].scale.turns)||1),m=Number((d%f+f)%f)+u/di;return{angle:u,text:ig(u),error:a,mean:o,whole:d,along:m}}followed(t,e){let{body:n,base:s,speed:r}=this.scene.pointers[t],o=nt.of(e),a=this.errors(o);return{mean:r===null?nt.of(0):nt.of(r).times(o),error:a[n]-a[s]}}played(t,e){let{body:n,base:s}=this.scene.pointers[t],r=this.time(e),o=this.run.turned(n,r)-this.run.turned(s,r)+this.initial[n]-this.initial[s];return{mean:nt.of(0),error:o}}aheadBy(t,e=this.turns){let{speed:n}=this.scene.pointers[t],{mean:s,error:r}=this.followed(t,this.made(e));return(Number(nt.of(n??"0"))*this.run.links[this.scene.driving_link].rate<0?-1:1)*(this.played(t,e).error-di*Number(s)-r)}},ig=i=>`${(i*180/Math.PI).toFixed(3)}°`,no=class{constructor({transmissions:t,sources:e,steps:n,offsets:s},r){this.count=r.length,this.transmissions=t.map(o=>new to(o)),this.sources=e.map(o=>({...o,cycles:nt.of(o.cycles)})),this.steps=n,this.offsets=Object.entries(s).map(([o,a])=>[r.indexOf(o),a])}at(t){let e=new Float64Array(this.sources.length);for(let s of this.steps)this.take(s,t,e);let n=new Float64Array(this.count);this.sources.forEach(({bodies:s,weights:r},o)=>s.forEach((a,l)=>n[a]+=r[l]*e[o]));for(let[s,r]of this.offsets)n[s]+=r;return n}take({sources:t,known:e,from_known:n,own:s},r,o){let a=t.map(u=>this.sources[u]),l=a.map(u=>this.transmissions[u.transmission]),c=a.map(({start:u,cycles:d},f)=>e.reduce((m,x,p)=>m+n[f][p]*o[x],u+cc(d,r)*l[f].period)),h=s.length?Ju(l,a.map(({sense:u})=>u),c,s):a.map(({sense:u},d)=>u*l[d].at(c[d])[0]);t.forEach((u,d)=>o[u]=h[d])}};var Ai={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},Ri={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},Rd=0,Gc=1,Cd=2;var Mr=1,Pd=2,Ss=3,Gn=0,Ze=1,fn=2,Hi=0,ws=1,Hc=2,Wc=3,Xc=4,Id=5;var Wi=100,Ld=101,Dd=102,Nd=103,Od=104,Ud=200,Fd=201,Bd=202,kd=203,qc=204,$c=205,zd=206,Vd=207,Gd=208,Hd=209,Wd=210,Xd=211,qd=212,$d=213,Yd=214,Po=0,Io=1,Lo=2,fs=3,Do=4,No=5,Oo=6,Uo=7,Yc=0,Zd=1,Jd=2,Hn=0,Zc=1,Jc=2,Kc=3,jc=4,Qc=5,th=6,eh=7;var nh=300,Xi=301,Es=302,oa=303,aa=304,Fo=1e3,Fn=1001,Bo=1002,_e=1003,Kd=1004;var br=1005;var $e=1006,la=1007;var si=1008;var Je=1009,ih=1010,sh=1011,Ts=1012,ca=1013,Cn=1014,pn=1015,Pn=1016,ha=1017,ua=1018,qi=1020,rh=35902,oh=35899,ah=1021,lh=1022,Ke=1023,ni=1026,ri=1027,ch=1028,da=1029,Ci=1030,fa=1031;var pa=1033,Sr=33776,wr=33777,Er=33778,Tr=33779,ma=35840,ga=35841,_a=35842,xa=35843,ya=36196,va=37492,Ma=37496,ba=37488,Sa=37489,Ar=37490,wa=37491,Ea=37808,Ta=37809,Aa=37810,Ra=37811,Ca=37812,Pa=37813,Ia=37814,La=37815,Da=37816,Na=37817,Oa=37818,Ua=37819,Fa=37820,Ba=37821,ka=36492,za=36494,Va=36495,Ga=36283,Ha=36284,Rr=36285,Wa=36286;var Qs=2300,ko=2301,Ro=2302,Ic=2303,Lc=2400,Dc=2401,Nc=2402;var jd=3200;var hh=0,Qd=1,oi="",an="srgb",tr="srgb-linear",er="linear",ie="srgb";var Co=7680;var tf=519,ef=512,nf=513,sf=514,uh=515,rf=516,of=517,dh=518,fh=519,af=35044;var ai="300 es",Mn=2e3,nr=2001;function sg(i){for(let t=i.length-1;t>=0;--t)if(i[t]>=65535)return!0;return!1}function rg(i){return ArrayBuffer.isView(i)&&!(i instanceof DataView)}function ir(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function lf(){let i=ir("canvas");return i.style.display="block",i}var Qu={},ps=null;function ph(...i){let t="THREE."+i.shift();ps?ps("log",t,...i):console.log(t,...i)}function cf(i){let t=i[0];if(typeof t=="string"&&t.startsWith("TSL:")){let e=i[1];e&&e.isStackTrace?i[0]+=" "+e.getLocation():i[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return i}function Lt(...i){i=cf(i);let t="THREE."+i.shift();if(ps)ps("warn",t,...i);else{let e=i[0];e&&e.isStackTrace?console.warn(e.getError(t)):console.warn(t,...i)}}function Nt(...i){i=cf(i);let t="THREE."+i.shift();if(ps)ps("error",t,...i);else{let e=i[0];e&&e.isStackTrace?console.error(e.getError(t)):console.error(t,...i)}}function Js(...i){let t=i.join(" ");t in Qu||(Qu[t]=!0,Lt(...i))}function hf(i,t,e){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(t,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:n()}}setTimeout(r,e)})}var uf={[Po]:Po,[Lo]:Oo,[Do]:Do,[fs]:No,[Io]:Io,[Oo]:Lo,[Uo]:Uo,[No]:fs},An=class{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});let n=this._listeners;n[t]===void 0&&(n[t]=[]),n[t].indexOf(e)===-1&&n[t].push(e)}hasEventListener(t,e){let n=this._listeners;return n===void 0?!1:n[t]!==void 0&&n[t].indexOf(e)!==-1}removeEventListener(t,e){let n=this._listeners;if(n===void 0)return;let s=n[t];if(s!==void 0){let r=s.indexOf(e);r!==-1&&s.splice(r,1)}}dispatchEvent(t){let e=this._listeners;if(e===void 0)return;let n=e[t.type];if(n!==void 0){t.target=this;let s=n.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,t);t.target=null}}},ze=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],td=1234567,Ks=Math.PI/180,ms=180/Math.PI;function As(){let i=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(ze[i&255]+ze[i>>8&255]+ze[i>>16&255]+ze[i>>24&255]+"-"+ze[t&255]+ze[t>>8&255]+"-"+ze[t>>16&15|64]+ze[t>>24&255]+"-"+ze[e&63|128]+ze[e>>8&255]+"-"+ze[e>>16&255]+ze[e>>24&255]+ze[n&255]+ze[n>>8&255]+ze[n>>16&255]+ze[n>>24&255]).toLowerCase()}function qt(i,t,e){return Math.max(t,Math.min(e,i))}function mh(i,t){return(i%t+t)%t}function og(i,t,e,n,s){return n+(i-t)*(s-n)/(e-t)}function ag(i,t,e){return i!==t?(e-i)/(t-i):0}function js(i,t,e){return(1-e)*i+e*t}function lg(i,t,e,n){return js(i,t,1-Math.exp(-e*n))}function cg(i,t=1){return t-Math.abs(mh(i,t*2)-t)}function hg(i,t,e){return i<=t?0:i>=e?1:(i=(i-t)/(e-t),i*i*(3-2*i))}function ug(i,t,e){return i<=t?0:i>=e?1:(i=(i-t)/(e-t),i*i*i*(i*(i*6-15)+10))}function dg(i,t){return i+Math.floor(Math.random()*(t-i+1))}function fg(i,t){return i+Math.random()*(t-i)}function pg(i){return i*(.5-Math.random())}function mg(i){i!==void 0&&(td=i);let t=td+=1831565813;return t=Math.imul(t^t>>>15,t|1),t^=t+Math.imul(t^t>>>7,t|61),((t^t>>>14)>>>0)/4294967296}function gg(i){return i*Ks}function _g(i){return i*ms}function xg(i){return i>0&&Number.isInteger(i)&&2**Math.round(Math.log2(i))===i}function yg(i){return Math.pow(2,Math.ceil(Math.log(i)/Math.LN2))}function gh(i){return Math.pow(2,Math.floor(Math.log(i)/Math.LN2))}function vg(i,t,e,n,s){let r=Math.cos,o=Math.sin,a=r(e/2),l=o(e/2),c=r((t+n)/2),h=o((t+n)/2),u=r((t-n)/2),d=o((t-n)/2),f=r((n-t)/2),m=o((n-t)/2);switch(s){case"XYX":i.set(a*h,l*u,l*d,a*c);break;case"YZY":i.set(l*d,a*h,l*u,a*c);break;case"ZXZ":i.set(l*u,l*d,a*h,a*c);break;case"XZX":i.set(a*h,l*m,l*f,a*c);break;case"YXY":i.set(l*f,a*h,l*m,a*c);break;case"ZYZ":i.set(l*m,l*f,a*h,a*c);break;default:Lt("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function _h(i){switch(i.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function df(i,t){if(t.constructor===Float32Array)return i;let e=_h(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(i/e,-1)}function ff(i,t){if(t.constructor===Float32Array)return i;let e=_h(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(i*e)}var xh={DEG2RAD:Ks,RAD2DEG:ms,generateUUID:As,clamp:qt,euclideanModulo:mh,mapLinear:og,inverseLerp:ag,lerp:js,damp:lg,pingpong:cg,smoothstep:hg,smootherstep:ug,randInt:dg,randFloat:fg,randFloatSpread:pg,seededRandom:mg,degToRad:gg,radToDeg:_g,isPowerOfTwo:xg,ceilPowerOfTwo:yg,floorPowerOfTwo:gh,setQuaternionFromProperEuler:vg,normalize:ff,denormalize:df},It=class{static{this.prototype.isVector2=!0}constructor(t=0,e=0){this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("THREE.Vector2: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){let e=this.x,n=this.y,s=t.elements;return this.x=s[0]*e+s[3]*n+s[6],this.y=s[1]*e+s[4]*n+s[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=qt(this.x,t.x,e.x),this.y=qt(this.y,t.y,e.y),this}clampScalar(t,e){return this.x=qt(this.x,t,e),this.y=qt(this.y,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(qt(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let n=this.dot(t)/e;return Math.acos(qt(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,n=this.y-t.y;return e*e+n*n}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){let n=Math.cos(e),s=Math.sin(e),r=this.x-t.x,o=this.y-t.y;return this.x=r*n-o*s+t.x,this.y=r*s+o*n+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},ln=class{constructor(t=0,e=0,n=0,s=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=n,this._w=s}static slerpFlat(t,e,n,s,r,o,a){let l=n[s+0],c=n[s+1],h=n[s+2],u=n[s+3],d=r[o+0],f=r[o+1],m=r[o+2],x=r[o+3];if(u!==x||l!==d||c!==f||h!==m){let p=l*d+c*f+h*m+u*x;p<0&&(d=-d,f=-f,m=-m,x=-x,p=-p);let g=1-a;if(p<.9995){let S=Math.acos(p),w=Math.sin(S);g=Math.sin(g*S)/w,a=Math.sin(a*S)/w,l=l*g+d*a,c=c*g+f*a,h=h*g+m*a,u=u*g+x*a}else{l=l*g+d*a,c=c*g+f*a,h=h*g+m*a,u=u*g+x*a;let S=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=S,c*=S,h*=S,u*=S}}t[e]=l,t[e+1]=c,t[e+2]=h,t[e+3]=u}static multiplyQuaternionsFlat(t,e,n,s,r,o){let a=n[s],l=n[s+1],c=n[s+2],h=n[s+3],u=r[o],d=r[o+1],f=r[o+2],m=r[o+3];return t[e]=a*m+h*u+l*f-c*d,t[e+1]=l*m+h*d+c*u-a*f,t[e+2]=c*m+h*f+a*d-l*u,t[e+3]=h*m-a*u-l*d-c*f,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,n,s){return this._x=t,this._y=e,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){let n=t._x,s=t._y,r=t._z,o=t._order,a=Math.cos,l=Math.sin,c=a(n/2),h=a(s/2),u=a(r/2),d=l(n/2),f=l(s/2),m=l(r/2);switch(o){case"XYZ":this._x=d*h*u+c*f*m,this._y=c*f*u-d*h*m,this._z=c*h*m+d*f*u,this._w=c*h*u-d*f*m;break;case"YXZ":this._x=d*h*u+c*f*m,this._y=c*f*u-d*h*m,this._z=c*h*m-d*f*u,this._w=c*h*u+d*f*m;break;case"ZXY":this._x=d*h*u-c*f*m,this._y=c*f*u+d*h*m,this._z=c*h*m+d*f*u,this._w=c*h*u-d*f*m;break;case"ZYX":this._x=d*h*u-c*f*m,this._y=c*f*u+d*h*m,this._z=c*h*m-d*f*u,this._w=c*h*u+d*f*m;break;case"YZX":this._x=d*h*u+c*f*m,this._y=c*f*u+d*h*m,this._z=c*h*m-d*f*u,this._w=c*h*u-d*f*m;break;case"XZY":this._x=d*h*u-c*f*m,this._y=c*f*u-d*h*m,this._z=c*h*m+d*f*u,this._w=c*h*u+d*f*m;break;default:Lt("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){let n=e/2,s=Math.sin(n);return this._x=t.x*s,this._y=t.y*s,this._z=t.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(t){let e=t.elements,n=e[0],s=e[4],r=e[8],o=e[1],a=e[5],l=e[9],c=e[2],h=e[6],u=e[10],d=n+a+u;if(d>0){let f=.5/Math.sqrt(d+1);this._w=.25/f,this._x=(h-l)*f,this._y=(r-c)*f,this._z=(o-s)*f}else if(n>a&&n>u){let f=2*Math.sqrt(1+n-a-u);this._w=(h-l)/f,this._x=.25*f,this._y=(s+o)/f,this._z=(r+c)/f}else if(a>u){let f=2*Math.sqrt(1+a-n-u);this._w=(r-c)/f,this._x=(s+o)/f,this._y=.25*f,this._z=(l+h)/f}else{let f=2*Math.sqrt(1+u-n-a);this._w=(o-s)/f,this._x=(r+c)/f,this._y=(l+h)/f,this._z=.25*f}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let n=t.dot(e)+1;return n<1e-8?(n=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=n):(this._x=0,this._y=-t.z,this._z=t.y,this._w=n)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=n),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(qt(this.dot(t),-1,1)))}rotateTowards(t,e){let n=this.angleTo(t);if(n===0)return this;let s=Math.min(1,e/n);return this.slerp(t,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){let n=t._x,s=t._y,r=t._z,o=t._w,a=e._x,l=e._y,c=e._z,h=e._w;return this._x=n*h+o*a+s*c-r*l,this._y=s*h+o*l+r*a-n*c,this._z=r*h+o*c+n*l-s*a,this._w=o*h-n*a-s*l-r*c,this._onChangeCallback(),this}slerp(t,e){let n=t._x,s=t._y,r=t._z,o=t._w,a=this.dot(t);a<0&&(n=-n,s=-s,r=-r,o=-o,a=-a);let l=1-e;if(a<.9995){let c=Math.acos(a),h=Math.sin(c);l=Math.sin(l*c)/h,e=Math.sin(e*c)/h,this._x=this._x*l+n*e,this._y=this._y*l+s*e,this._z=this._z*l+r*e,this._w=this._w*l+o*e,this._onChangeCallback()}else this._x=this._x*l+n*e,this._y=this._y*l+s*e,this._z=this._z*l+r*e,this._w=this._w*l+o*e,this.normalize();return this}slerpQuaternions(t,e,n){return this.copy(t).slerp(e,n)}random(){let t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(t),s*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},N=class{static{this.prototype.isVector3=!0}constructor(t=0,e=0,n=0){this.x=t,this.y=e,this.z=n}set(t,e,n){return n===void 0&&(n=this.z),this.x=t,this.y=e,this.z=n,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("THREE.Vector3: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(ed.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(ed.setFromAxisAngle(t,e))}applyMatrix3(t){let e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[3]*n+r[6]*s,this.y=r[1]*e+r[4]*n+r[7]*s,this.z=r[2]*e+r[5]*n+r[8]*s,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){let e=this.x,n=this.y,s=this.z,r=t.elements,o=1/(r[3]*e+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*e+r[4]*n+r[8]*s+r[12])*o,this.y=(r[1]*e+r[5]*n+r[9]*s+r[13])*o,this.z=(r[2]*e+r[6]*n+r[10]*s+r[14])*o,this}applyQuaternion(t){let e=this.x,n=this.y,s=this.z,r=t.x,o=t.y,a=t.z,l=t.w,c=2*(o*s-a*n),h=2*(a*e-r*s),u=2*(r*n-o*e);return this.x=e+l*c+o*u-a*h,this.y=n+l*h+a*c-r*u,this.z=s+l*u+r*h-o*c,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){let e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[4]*n+r[8]*s,this.y=r[1]*e+r[5]*n+r[9]*s,this.z=r[2]*e+r[6]*n+r[10]*s,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=qt(this.x,t.x,e.x),this.y=qt(this.y,t.y,e.y),this.z=qt(this.z,t.z,e.z),this}clampScalar(t,e){return this.x=qt(this.x,t,e),this.y=qt(this.y,t,e),this.z=qt(this.z,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(qt(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){let n=t.x,s=t.y,r=t.z,o=e.x,a=e.y,l=e.z;return this.x=s*l-r*a,this.y=r*o-n*l,this.z=n*a-s*o,this}projectOnVector(t){let e=t.lengthSq();if(e===0)return this.set(0,0,0);let n=t.dot(this)/e;return this.copy(t).multiplyScalar(n)}projectOnPlane(t){return dc.copy(this).projectOnVector(t),this.sub(dc)}reflect(t){return this.sub(dc.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let n=this.dot(t)/e;return Math.acos(qt(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,n=this.y-t.y,s=this.z-t.z;return e*e+n*n+s*s}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,n){let s=Math.sin(e)*t;return this.x=s*Math.sin(n),this.y=Math.cos(e)*t,this.z=s*Math.cos(n),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,n){return this.x=t*Math.sin(e),this.y=n,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){let e=this.setFromMatrixColumn(t,0).length(),n=this.setFromMatrixColumn(t,1).length(),s=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=n,this.z=s,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let t=Math.random()*Math.PI*2,e=Math.random()*2-1,n=Math.sqrt(1-e*e);return this.x=n*Math.cos(t),this.y=e,this.z=n*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},dc=new N,ed=new ln,Ot=class{static{this.prototype.isMatrix3=!0}constructor(t,e,n,s,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,o,a,l,c)}set(t,e,n,s,r,o,a,l,c){let h=this.elements;return h[0]=t,h[1]=s,h[2]=a,h[3]=e,h[4]=r,h[5]=l,h[6]=n,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){let e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],this}extractBasis(t,e,n){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(t){let e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let n=t.elements,s=e.elements,r=this.elements,o=n[0],a=n[3],l=n[6],c=n[1],h=n[4],u=n[7],d=n[2],f=n[5],m=n[8],x=s[0],p=s[3],g=s[6],S=s[1],w=s[4],b=s[7],R=s[2],A=s[5],_=s[8];return r[0]=o*x+a*S+l*R,r[3]=o*p+a*w+l*A,r[6]=o*g+a*b+l*_,r[1]=c*x+h*S+u*R,r[4]=c*p+h*w+u*A,r[7]=c*g+h*b+u*_,r[2]=d*x+f*S+m*R,r[5]=d*p+f*w+m*A,r[8]=d*g+f*b+m*_,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8];return e*o*h-e*a*c-n*r*h+n*a*l+s*r*c-s*o*l}invert(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],u=h*o-a*c,d=a*l-h*r,f=c*r-o*l,m=e*u+n*d+s*f;if(m===0)return this.set(0,0,0,0,0,0,0,0,0);let x=1/m;return t[0]=u*x,t[1]=(s*c-h*n)*x,t[2]=(a*n-s*o)*x,t[3]=d*x,t[4]=(h*e-s*l)*x,t[5]=(s*r-a*e)*x,t[6]=f*x,t[7]=(n*l-c*e)*x,t[8]=(o*e-n*r)*x,this}transpose(){let t,e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){let e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,n,s,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*o+c*a)+o+t,-s*c,s*l,-s*(-c*o+l*a)+a+e,0,0,1),this}scale(t,e){return Js("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(fc.makeScale(t,e)),this}rotate(t){return Js("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(fc.makeRotation(-t)),this}translate(t,e){return Js("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(fc.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,n,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){let e=this.elements,n=t.elements;for(let s=0;s<9;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<9;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){let n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t}clone(){return new this.constructor().fromArray(this.elements)}},fc=new Ot,nd=new Ot().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),id=new Ot().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function Mg(){let i={enabled:!0,workingColorSpace:tr,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===ie&&(s.r=ei(s.r),s.g=ei(s.g),s.b=ei(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===ie&&(s.r=ds(s.r),s.g=ds(s.g),s.b=ds(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===oi?er:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},t=[.64,.33,.3,.6,.15,.06],e=[.2126,.7152,.0722],n=[.3127,.329];return i.define({[tr]:{primaries:t,whitePoint:n,transfer:er,toXYZ:nd,fromXYZ:id,luminanceCoefficients:e,workingColorSpaceConfig:{unpackColorSpace:an},outputColorSpaceConfig:{drawingBufferColorSpace:an}},[an]:{primaries:t,whitePoint:n,transfer:ie,toXYZ:nd,fromXYZ:id,luminanceCoefficients:e,outputColorSpaceConfig:{drawingBufferColorSpace:an}}}),i}var Kt=Mg();function ei(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function ds(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}var Qi,zo=class{static getDataURL(t,e="image/png"){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let n;if(t instanceof HTMLCanvasElement)n=t;else{Qi===void 0&&(Qi=ir("canvas")),Qi.width=t.width,Qi.height=t.height;let s=Qi.getContext("2d");t instanceof ImageData?s.putImageData(t,0,0):s.drawImage(t,0,0,t.width,t.height),n=Qi}return n.toDataURL(e)}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){let e=ir("canvas");e.width=t.width,e.height=t.height;let n=e.getContext("2d");n.drawImage(t,0,0,t.width,t.height);let s=n.getImageData(0,0,t.width,t.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=ei(r[o]/255)*255;return n.putImageData(s,0,0),e}else if(t.data){let e=t.data.slice(0);for(let n=0;n<e.length;n++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[n]=Math.floor(ei(e[n]/255)*255):e[n]=ei(e[n]);return{data:e,width:t.width,height:t.height}}else return Lt("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}},bg=0,gs=class{constructor(t=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:bg++}),this.uuid=As(),this.data=t,this.dataReady=!0,this.version=0}getSize(t){let e=this.data;return typeof HTMLVideoElement<"u"&&e instanceof HTMLVideoElement?t.set(e.videoWidth,e.videoHeight,0):typeof VideoFrame<"u"&&e instanceof VideoFrame?t.set(e.displayWidth,e.displayHeight,0):e!==null?t.set(e.width||0,e.height||0,e.depth||0):t.set(0,0,0),t}set needsUpdate(t){t===!0&&this.version++}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];let n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(pc(s[o].image)):r.push(pc(s[o]))}else r=pc(s);n.url=r}return e||(t.images[this.uuid]=n),n}};function pc(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?zo.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(Lt("Texture: Unable to serialize Texture."),{})}var Sg=0,mc=new N,Qe=class i extends An{constructor(t=i.DEFAULT_IMAGE,e=i.DEFAULT_MAPPING,n=Fn,s=Fn,r=$e,o=si,a=Ke,l=Je,c=i.DEFAULT_ANISOTROPY,h=oi){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:Sg++}),this.uuid=As(),this.name="",this.source=new gs(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new It(0,0),this.repeat=new It(1,1),this.center=new It(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new Ot,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(t&&t.depth&&t.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(mc).x}get height(){return this.source.getSize(mc).y}get depth(){return this.source.getSize(mc).z}get image(){return this.source.data}set image(t){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.normalized=t.normalized,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.mipmapsAutoUpdate=t.mipmapsAutoUpdate,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.renderTarget=t.renderTarget,this.isRenderTargetTexture=t.isRenderTargetTexture,this.isPMREMTexture=t.isPMREMTexture,this.isArrayTexture=t.isArrayTexture,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}setValues(t){for(let e in t){let n=t[e];if(n===void 0){Lt(`Texture.setValues(): parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){Lt(`Texture.setValues(): property '${e}' does not exist.`);continue}s&&n&&s.isVector2&&n.isVector2||s&&n&&s.isVector3&&n.isVector3||s&&n&&s.isMatrix3&&n.isMatrix3?s.copy(n):this[e]=n}}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];let n={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),e||(t.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==nh)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case Fo:t.x=t.x-Math.floor(t.x);break;case Fn:t.x=t.x<0?0:1;break;case Bo:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case Fo:t.y=t.y-Math.floor(t.y);break;case Fn:t.y=t.y<0?0:1;break;case Bo:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}};Qe.DEFAULT_IMAGE=null;Qe.DEFAULT_MAPPING=nh;Qe.DEFAULT_ANISOTROPY=1;var ge=class{static{this.prototype.isVector4=!0}constructor(t=0,e=0,n=0,s=1){this.x=t,this.y=e,this.z=n,this.w=s}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,n,s){return this.x=t,this.y=e,this.z=n,this.w=s,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("THREE.Vector4: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){let e=this.x,n=this.y,s=this.z,r=this.w,o=t.elements;return this.x=o[0]*e+o[4]*n+o[8]*s+o[12]*r,this.y=o[1]*e+o[5]*n+o[9]*s+o[13]*r,this.z=o[2]*e+o[6]*n+o[10]*s+o[14]*r,this.w=o[3]*e+o[7]*n+o[11]*s+o[15]*r,this}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this.w/=t.w,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);let e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,n,s,r,l=t.elements,c=l[0],h=l[4],u=l[8],d=l[1],f=l[5],m=l[9],x=l[2],p=l[6],g=l[10];if(Math.abs(h-d)<.01&&Math.abs(u-x)<.01&&Math.abs(m-p)<.01){if(Math.abs(h+d)<.1&&Math.abs(u+x)<.1&&Math.abs(m+p)<.1&&Math.abs(c+f+g-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;let w=(c+1)/2,b=(f+1)/2,R=(g+1)/2,A=(h+d)/4,_=(u+x)/4,E=(m+p)/4;return w>b&&w>R?w<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(w),s=A/n,r=_/n):b>R?b<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(b),n=A/s,r=E/s):R<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(R),n=_/r,s=E/r),this.set(n,s,r,e),this}let S=Math.sqrt((p-m)*(p-m)+(u-x)*(u-x)+(d-h)*(d-h));return Math.abs(S)<.001&&(S=1),this.x=(p-m)/S,this.y=(u-x)/S,this.z=(d-h)/S,this.w=Math.acos((c+f+g-1)/2),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=qt(this.x,t.x,e.x),this.y=qt(this.y,t.y,e.y),this.z=qt(this.z,t.z,e.z),this.w=qt(this.w,t.w,e.w),this}clampScalar(t,e){return this.x=qt(this.x,t,e),this.y=qt(this.y,t,e),this.z=qt(this.z,t,e),this.w=qt(this.w,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(qt(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this.w=t.w+(e.w-t.w)*n,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},Vo=class extends An{constructor(t=1,e=1,n={}){super(),n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:$e,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},n),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=n.depth,this.scissor=new ge(0,0,t,e),this.scissorTest=!1,this.viewport=new ge(0,0,t,e),this.textures=[];let s=n.count;for(let r=0;r<s;r++)this.textures[r]=new Qe({width:t,height:e,depth:n.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(n),this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveColorBuffer=n.resolveColorBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.storeMultisampledColorBuffer=n.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=n.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=n.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=n.depthTexture,this.samples=n.samples,this.multiview=n.multiview,this.useArrayDepthTexture=n.useArrayDepthTexture}_setTextureOptions(t={}){let e={minFilter:$e,generateMipmaps:!1,flipY:!1,internalFormat:null};t.mapping!==void 0&&(e.mapping=t.mapping),t.wrapS!==void 0&&(e.wrapS=t.wrapS),t.wrapT!==void 0&&(e.wrapT=t.wrapT),t.wrapR!==void 0&&(e.wrapR=t.wrapR),t.magFilter!==void 0&&(e.magFilter=t.magFilter),t.minFilter!==void 0&&(e.minFilter=t.minFilter),t.format!==void 0&&(e.format=t.format),t.type!==void 0&&(e.type=t.type),t.anisotropy!==void 0&&(e.anisotropy=t.anisotropy),t.colorSpace!==void 0&&(e.colorSpace=t.colorSpace),t.flipY!==void 0&&(e.flipY=t.flipY),t.generateMipmaps!==void 0&&(e.generateMipmaps=t.generateMipmaps),t.mipmapsAutoUpdate!==void 0&&(e.mipmapsAutoUpdate=t.mipmapsAutoUpdate),t.internalFormat!==void 0&&(e.internalFormat=t.internalFormat);for(let n=0;n<this.textures.length;n++)this.textures[n].setValues(e)}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}set depthTexture(t){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),t!==null&&t.renderTarget===null&&(t.renderTarget=this),this._depthTexture=t}get depthTexture(){return this._depthTexture}setSize(t,e,n=1){if(this.width!==t||this.height!==e||this.depth!==n){this.width=t,this.height=e,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=t,this.textures[s].image.height=e,this.textures[s].image.depth=n,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let e=0,n=t.textures.length;e<n;e++){this.textures[e]=t.textures[e].clone(),this.textures[e].isRenderTargetTexture=!0,this.textures[e].renderTarget=this;let s=Object.assign({},t.textures[e].image);this.textures[e].source=new gs(s)}if(this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveColorBuffer=t.resolveColorBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,this.storeMultisampledColorBuffer=t.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=t.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=t.storeMultisampledStencilBuffer,t.depthTexture!==null)if(t.depthTexture.renderTarget===t){let e=t.depthTexture.clone();e.renderTarget=null,this.depthTexture=e}else this.depthTexture=t.depthTexture;else this.depthTexture=null;return this.samples=t.samples,this.multiview=t.multiview,this.useArrayDepthTexture=t.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},cn=class extends Vo{constructor(t=1,e=1,n={}){super(t,e,n),this.isWebGLRenderTarget=!0}},sr=class extends Qe{constructor(t=null,e=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=_e,this.minFilter=_e,this.wrapR=Fn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}};var Go=class extends Qe{constructor(t=null,e=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=_e,this.minFilter=_e,this.wrapR=Fn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}};var Qt=class i{static{this.prototype.isMatrix4=!0}constructor(t,e,n,s,r,o,a,l,c,h,u,d,f,m,x,p){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,o,a,l,c,h,u,d,f,m,x,p)}set(t,e,n,s,r,o,a,l,c,h,u,d,f,m,x,p){let g=this.elements;return g[0]=t,g[4]=e,g[8]=n,g[12]=s,g[1]=r,g[5]=o,g[9]=a,g[13]=l,g[2]=c,g[6]=h,g[10]=u,g[14]=d,g[3]=f,g[7]=m,g[11]=x,g[15]=p,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new i().fromArray(this.elements)}copy(t){let e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],e[9]=n[9],e[10]=n[10],e[11]=n[11],e[12]=n[12],e[13]=n[13],e[14]=n[14],e[15]=n[15],this}copyPosition(t){let e=this.elements,n=t.elements;return e[12]=n[12],e[13]=n[13],e[14]=n[14],this}setFromMatrix3(t){let e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,n){return this.determinantAffine()===0?(t.set(1,0,0),e.set(0,1,0),n.set(0,0,1),this):(t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this)}makeBasis(t,e,n){return this.set(t.x,e.x,n.x,0,t.y,e.y,n.y,0,t.z,e.z,n.z,0,0,0,0,1),this}extractRotation(t){if(t.determinantAffine()===0)return this.identity();let e=this.elements,n=t.elements,s=1/ts.setFromMatrixColumn(t,0).length(),r=1/ts.setFromMatrixColumn(t,1).length(),o=1/ts.setFromMatrixColumn(t,2).length();return e[0]=n[0]*s,e[1]=n[1]*s,e[2]=n[2]*s,e[3]=0,e[4]=n[4]*r,e[5]=n[5]*r,e[6]=n[6]*r,e[7]=0,e[8]=n[8]*o,e[9]=n[9]*o,e[10]=n[10]*o,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){let e=this.elements,n=t.x,s=t.y,r=t.z,o=Math.cos(n),a=Math.sin(n),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(t.order==="XYZ"){let d=o*h,f=o*u,m=a*h,x=a*u;e[0]=l*h,e[4]=-l*u,e[8]=c,e[1]=f+m*c,e[5]=d-x*c,e[9]=-a*l,e[2]=x-d*c,e[6]=m+f*c,e[10]=o*l}else if(t.order==="YXZ"){let d=l*h,f=l*u,m=c*h,x=c*u;e[0]=d+x*a,e[4]=m*a-f,e[8]=o*c,e[1]=o*u,e[5]=o*h,e[9]=-a,e[2]=f*a-m,e[6]=x+d*a,e[10]=o*l}else if(t.order==="ZXY"){let d=l*h,f=l*u,m=c*h,x=c*u;e[0]=d-x*a,e[4]=-o*u,e[8]=m+f*a,e[1]=f+m*a,e[5]=o*h,e[9]=x-d*a,e[2]=-o*c,e[6]=a,e[10]=o*l}else if(t.order==="ZYX"){let d=o*h,f=o*u,m=a*h,x=a*u;e[0]=l*h,e[4]=m*c-f,e[8]=d*c+x,e[1]=l*u,e[5]=x*c+d,e[9]=f*c-m,e[2]=-c,e[6]=a*l,e[10]=o*l}else if(t.order==="YZX"){let d=o*l,f=o*c,m=a*l,x=a*c;e[0]=l*h,e[4]=x-d*u,e[8]=m*u+f,e[1]=u,e[5]=o*h,e[9]=-a*h,e[2]=-c*h,e[6]=f*u+m,e[10]=d-x*u}else if(t.order==="XZY"){let d=o*l,f=o*c,m=a*l,x=a*c;e[0]=l*h,e[4]=-u,e[8]=c*h,e[1]=d*u+x,e[5]=o*h,e[9]=f*u-m,e[2]=m*u-f,e[6]=a*h,e[10]=x*u+d}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(wg,t,Eg)}lookAt(t,e,n){let s=this.elements;return rn.subVectors(t,e),rn.lengthSq()===0&&(rn.z=1),rn.normalize(),pi.crossVectors(n,rn),pi.lengthSq()===0&&(Math.abs(n.z)===1?rn.x+=1e-4:rn.z+=1e-4,rn.normalize(),pi.crossVectors(n,rn)),pi.normalize(),io.crossVectors(rn,pi),s[0]=pi.x,s[4]=io.x,s[8]=rn.x,s[1]=pi.y,s[5]=io.y,s[9]=rn.y,s[2]=pi.z,s[6]=io.z,s[10]=rn.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let n=t.elements,s=e.elements,r=this.elements,o=n[0],a=n[4],l=n[8],c=n[12],h=n[1],u=n[5],d=n[9],f=n[13],m=n[2],x=n[6],p=n[10],g=n[14],S=n[3],w=n[7],b=n[11],R=n[15],A=s[0],_=s[4],E=s[8],k=s[12],L=s[1],O=s[5],V=s[9],Y=s[13],I=s[2],q=s[6],j=s[10],H=s[14],st=s[3],X=s[7],tt=s[11],et=s[15];return r[0]=o*A+a*L+l*I+c*st,r[4]=o*_+a*O+l*q+c*X,r[8]=o*E+a*V+l*j+c*tt,r[12]=o*k+a*Y+l*H+c*et,r[1]=h*A+u*L+d*I+f*st,r[5]=h*_+u*O+d*q+f*X,r[9]=h*E+u*V+d*j+f*tt,r[13]=h*k+u*Y+d*H+f*et,r[2]=m*A+x*L+p*I+g*st,r[6]=m*_+x*O+p*q+g*X,r[10]=m*E+x*V+p*j+g*tt,r[14]=m*k+x*Y+p*H+g*et,r[3]=S*A+w*L+b*I+R*st,r[7]=S*_+w*O+b*q+R*X,r[11]=S*E+w*V+b*j+R*tt,r[15]=S*k+w*Y+b*H+R*et,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){let t=this.elements,e=t[0],n=t[4],s=t[8],r=t[12],o=t[1],a=t[5],l=t[9],c=t[13],h=t[2],u=t[6],d=t[10],f=t[14],m=t[3],x=t[7],p=t[11],g=t[15],S=l*f-c*d,w=a*f-c*u,b=a*d-l*u,R=o*f-c*h,A=o*d-l*h,_=o*u-a*h;return e*(x*S-p*w+g*b)-n*(m*S-p*R+g*A)+s*(m*w-x*R+g*_)-r*(m*b-x*A+p*_)}determinantAffine(){let t=this.elements,e=t[0],n=t[4],s=t[8],r=t[1],o=t[5],a=t[9],l=t[2],c=t[6],h=t[10];return e*(o*h-a*c)-n*(r*h-a*l)+s*(r*c-o*l)}transpose(){let t=this.elements,e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,n){let s=this.elements;return t.isVector3?(s[12]=t.x,s[13]=t.y,s[14]=t.z):(s[12]=t,s[13]=e,s[14]=n),this}invert(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],u=t[9],d=t[10],f=t[11],m=t[12],x=t[13],p=t[14],g=t[15],S=e*a-n*o,w=e*l-s*o,b=e*c-r*o,R=n*l-s*a,A=n*c-r*a,_=s*c-r*l,E=h*x-u*m,k=h*p-d*m,L=h*g-f*m,O=u*p-d*x,V=u*g-f*x,Y=d*g-f*p,I=S*Y-w*V+b*O+R*L-A*k+_*E;if(I===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let q=1/I;return t[0]=(a*Y-l*V+c*O)*q,t[1]=(s*V-n*Y-r*O)*q,t[2]=(x*_-p*A+g*R)*q,t[3]=(d*A-u*_-f*R)*q,t[4]=(l*L-o*Y-c*k)*q,t[5]=(e*Y-s*L+r*k)*q,t[6]=(p*b-m*_-g*w)*q,t[7]=(h*_-d*b+f*w)*q,t[8]=(o*V-a*L+c*E)*q,t[9]=(n*L-e*V-r*E)*q,t[10]=(m*A-x*b+g*S)*q,t[11]=(u*b-h*A-f*S)*q,t[12]=(a*k-o*O-l*E)*q,t[13]=(e*O-n*k+s*E)*q,t[14]=(x*w-m*R-p*S)*q,t[15]=(h*R-u*w+d*S)*q,this}scale(t){let e=this.elements,n=t.x,s=t.y,r=t.z;return e[0]*=n,e[4]*=s,e[8]*=r,e[1]*=n,e[5]*=s,e[9]*=r,e[2]*=n,e[6]*=s,e[10]*=r,e[3]*=n,e[7]*=s,e[11]*=r,this}getMaxScaleOnAxis(){let t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],n=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],s=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,n,s))}makeTranslation(t,e,n){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,n,0,0,0,1),this}makeRotationX(t){let e=Math.cos(t),n=Math.sin(t);return this.set(1,0,0,0,0,e,-n,0,0,n,e,0,0,0,0,1),this}makeRotationY(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,0,n,0,0,1,0,0,-n,0,e,0,0,0,0,1),this}makeRotationZ(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,0,n,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){let n=Math.cos(e),s=Math.sin(e),r=1-n,o=t.x,a=t.y,l=t.z,c=r*o,h=r*a;return this.set(c*o+n,c*a-s*l,c*l+s*a,0,c*a+s*l,h*a+n,h*l-s*o,0,c*l-s*a,h*l+s*o,r*l*l+n,0,0,0,0,1),this}makeScale(t,e,n){return this.set(t,0,0,0,0,e,0,0,0,0,n,0,0,0,0,1),this}makeShear(t,e,n,s,r,o){return this.set(1,n,r,0,t,1,o,0,e,s,1,0,0,0,0,1),this}compose(t,e,n){let s=this.elements,r=e._x,o=e._y,a=e._z,l=e._w,c=r+r,h=o+o,u=a+a,d=r*c,f=r*h,m=r*u,x=o*h,p=o*u,g=a*u,S=l*c,w=l*h,b=l*u,R=n.x,A=n.y,_=n.z;return s[0]=(1-(x+g))*R,s[1]=(f+b)*R,s[2]=(m-w)*R,s[3]=0,s[4]=(f-b)*A,s[5]=(1-(d+g))*A,s[6]=(p+S)*A,s[7]=0,s[8]=(m+w)*_,s[9]=(p-S)*_,s[10]=(1-(d+x))*_,s[11]=0,s[12]=t.x,s[13]=t.y,s[14]=t.z,s[15]=1,this}decompose(t,e,n){let s=this.elements;t.x=s[12],t.y=s[13],t.z=s[14];let r=this.determinantAffine();if(r===0)return n.set(1,1,1),e.identity(),this;let o=ts.set(s[0],s[1],s[2]).length(),a=ts.set(s[4],s[5],s[6]).length(),l=ts.set(s[8],s[9],s[10]).length();r<0&&(o=-o),wn.copy(this);let c=1/o,h=1/a,u=1/l;return wn.elements[0]*=c,wn.elements[1]*=c,wn.elements[2]*=c,wn.elements[4]*=h,wn.elements[5]*=h,wn.elements[6]*=h,wn.elements[8]*=u,wn.elements[9]*=u,wn.elements[10]*=u,e.setFromRotationMatrix(wn),n.x=o,n.y=a,n.z=l,this}makePerspective(t,e,n,s,r,o,a=Mn,l=!1){let c=this.elements,h=2*r/(e-t),u=2*r/(n-s),d=(e+t)/(e-t),f=(n+s)/(n-s),m,x;if(l)m=r/(o-r),x=o*r/(o-r);else if(a===Mn)m=-(o+r)/(o-r),x=-2*o*r/(o-r);else if(a===nr)m=-o/(o-r),x=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=d,c[12]=0,c[1]=0,c[5]=u,c[9]=f,c[13]=0,c[2]=0,c[6]=0,c[10]=m,c[14]=x,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(t,e,n,s,r,o,a=Mn,l=!1){let c=this.elements,h=2/(e-t),u=2/(n-s),d=-(e+t)/(e-t),f=-(n+s)/(n-s),m,x;if(l)m=1/(o-r),x=o/(o-r);else if(a===Mn)m=-2/(o-r),x=-(o+r)/(o-r);else if(a===nr)m=-1/(o-r),x=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=0,c[12]=d,c[1]=0,c[5]=u,c[9]=0,c[13]=f,c[2]=0,c[6]=0,c[10]=m,c[14]=x,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(t){let e=this.elements,n=t.elements;for(let s=0;s<16;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<16;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){let n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t[e+9]=n[9],t[e+10]=n[10],t[e+11]=n[11],t[e+12]=n[12],t[e+13]=n[13],t[e+14]=n[14],t[e+15]=n[15],t}},ts=new N,wn=new Qt,wg=new N(0,0,0),Eg=new N(1,1,1),pi=new N,io=new N,rn=new N,sd=new Qt,rd=new ln,vi=class i{constructor(t=0,e=0,n=0,s=i.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=n,this._order=s}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,n,s=this._order){return this._x=t,this._y=e,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,n=!0){let s=t.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],h=s[9],u=s[2],d=s[6],f=s[10];switch(e){case"XYZ":this._y=Math.asin(qt(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,f),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(d,c),this._z=0);break;case"YXZ":this._x=Math.asin(-qt(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,f),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(qt(d,-1,1)),Math.abs(d)<.9999999?(this._y=Math.atan2(-u,f),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-qt(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(d,f),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(qt(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,f));break;case"XZY":this._z=Math.asin(-qt(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(d,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,f),this._y=0);break;default:Lt("Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,n===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,n){return sd.makeRotationFromQuaternion(t),this.setFromRotationMatrix(sd,e,n)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return rd.setFromEuler(this),this.setFromQuaternion(rd,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};vi.DEFAULT_ORDER="XYZ";var _s=class{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}},Tg=0,od=new N,es=new ln,Jn=new Qt,so=new N,Xs=new N,Ag=new N,Rg=new ln,ad=new N(1,0,0),ld=new N(0,1,0),cd=new N(0,0,1),hd={type:"added"},Cg={type:"removed"},ns={type:"childadded",child:null},gc={type:"childremoved",child:null},hn=class i extends An{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:Tg++}),this.uuid=As(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=i.DEFAULT_UP.clone();let t=new N,e=new vi,n=new ln,s=new N(1,1,1);function r(){n.setFromEuler(e,!1)}function o(){e.setFromQuaternion(n,void 0,!1)}e._onChange(r),n._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new Qt},normalMatrix:{value:new Ot}}),this.matrix=new Qt,this.matrixWorld=new Qt,this.matrixAutoUpdate=i.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=i.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new _s,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return es.setFromAxisAngle(t,e),this.quaternion.multiply(es),this}rotateOnWorldAxis(t,e){return es.setFromAxisAngle(t,e),this.quaternion.premultiply(es),this}rotateX(t){return this.rotateOnAxis(ad,t)}rotateY(t){return this.rotateOnAxis(ld,t)}rotateZ(t){return this.rotateOnAxis(cd,t)}translateOnAxis(t,e){return od.copy(t).applyQuaternion(this.quaternion),this.position.add(od.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(ad,t)}translateY(t){return this.translateOnAxis(ld,t)}translateZ(t){return this.translateOnAxis(cd,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(Jn.copy(this.matrixWorld).invert())}lookAt(t,e,n){t.isVector3?so.copy(t):so.set(t,e,n);let s=this.parent;this.updateWorldMatrix(!0,!1),Xs.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Jn.lookAt(Xs,so,this.up):Jn.lookAt(so,Xs,this.up),this.quaternion.setFromRotationMatrix(Jn),s&&(Jn.extractRotation(s.matrixWorld),es.setFromRotationMatrix(Jn),this.quaternion.premultiply(es.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(Nt("Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(hd),ns.child=t,this.dispatchEvent(ns),ns.child=null):Nt("Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}let e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(Cg),gc.child=t,this.dispatchEvent(gc),gc.child=null),this}removeFromParent(){let t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),Jn.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),Jn.multiply(t.parent.matrixWorld)),t.applyMatrix4(Jn),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(hd),ns.child=t,this.dispatchEvent(ns),ns.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let n=0,s=this.children.length;n<s;n++){let o=this.children[n].getObjectByProperty(t,e);if(o!==void 0)return o}}getObjectsByProperty(t,e,n=[]){this[t]===e&&n.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(t,e,n);return n}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Xs,t,Ag),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Xs,Rg,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);let e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(t){t(this);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverseVisible(t)}traverseAncestors(t){let e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let t=this.pivot;if(t!==null){let e=t.x,n=t.y,s=t.z,r=this.matrix.elements;r[12]+=e-r[0]*e-r[4]*n-r[8]*s,r[13]+=n-r[1]*e-r[5]*n-r[9]*s,r[14]+=s-r[2]*e-r[6]*n-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].updateMatrixWorld(t)}updateWorldMatrix(t,e,n=!1){let s=this.parent;if(t===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||n)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,n=!0),e===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,n)}}toJSON(t){let e=t===void 0||typeof t=="string",n={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(t),s.indirectTexture=this._indirectTexture.toJSON(t),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(t)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(t.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(t.shapes,u)}else r(t.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(t.materials,this.material[l]));s.material=a}else s.material=r(t.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(t).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];s.animations.push(r(t.animations,l))}}if(e){let a=o(t.geometries),l=o(t.materials),c=o(t.textures),h=o(t.images),u=o(t.shapes),d=o(t.skeletons),f=o(t.animations),m=o(t.nodes);a.length>0&&(n.geometries=a),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),h.length>0&&(n.images=h),u.length>0&&(n.shapes=u),d.length>0&&(n.skeletons=d),f.length>0&&(n.animations=f),m.length>0&&(n.nodes=m)}return n.object=s,n;function o(a){let l=[];for(let c in a){let h=a[c];delete h.metadata,l.push(h)}return l}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.pivot=t.pivot!==null?t.pivot.clone():null,this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.static=t.static,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let n=0;n<t.children.length;n++){let s=t.children[n];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};hn.DEFAULT_UP=new N(0,1,0);hn.DEFAULT_MATRIX_AUTO_UPDATE=!0;hn.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Bn=class extends hn{constructor(){super(),this.isGroup=!0,this.type="Group"}},Pg={type:"move"},xs=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Bn,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Bn,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new N,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new N),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Bn,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new N,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new N,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){let e=this._hand;if(e)for(let n of t.hand.values())this._getHandJoint(e,n)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,n){let s=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(c&&t.hand){o=!0;for(let x of t.hand.values()){let p=e.getJointPose(x,n),g=this._getHandJoint(c,x);p!==null&&(g.matrix.fromArray(p.transform.matrix),g.matrix.decompose(g.position,g.quaternion,g.scale),g.matrixWorldNeedsUpdate=!0,g.jointRadius=p.radius),g.visible=p!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],d=h.position.distanceTo(u.position),f=.02,m=.005;c.inputState.pinching&&d>f+m?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!c.inputState.pinching&&d<=f-m&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else l!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:t,target:this})));a!==null&&(s=e.getPose(t.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(Pg)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){let n=new Bn;n.matrixAutoUpdate=!1,n.visible=!1,t.joints[e.jointName]=n,t.add(n)}return t.joints[e.jointName]}},pf={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},mi={h:0,s:0,l:0},ro={h:0,s:0,l:0};function _c(i,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?i+(t-i)*6*e:e<1/2?t:e<2/3?i+(t-i)*6*(2/3-e):i}var Ut=class{constructor(t,e,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,n)}set(t,e,n){if(e===void 0&&n===void 0){let s=t;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(t,e,n);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=an){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,Kt.colorSpaceToWorking(this,e),this}setRGB(t,e,n,s=Kt.workingColorSpace){return this.r=t,this.g=e,this.b=n,Kt.colorSpaceToWorking(this,s),this}setHSL(t,e,n,s=Kt.workingColorSpace){if(t=mh(t,1),e=qt(e,0,1),n=qt(n,0,1),e===0)this.r=this.g=this.b=n;else{let r=n<=.5?n*(1+e):n+e-n*e,o=2*n-r;this.r=_c(o,r,t+1/3),this.g=_c(o,r,t),this.b=_c(o,r,t-1/3)}return Kt.colorSpaceToWorking(this,s),this}setStyle(t,e=an){function n(r){r!==void 0&&parseFloat(r)<1&&Lt("Color: Alpha component of "+t+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(t)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,e);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:Lt("Color: Unknown color model "+t)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(t)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(o===6)return this.setHex(parseInt(r,16),e);Lt("Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=an){let n=pf[t.toLowerCase()];return n!==void 0?this.setHex(n,e):Lt("Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=ei(t.r),this.g=ei(t.g),this.b=ei(t.b),this}copyLinearToSRGB(t){return this.r=ds(t.r),this.g=ds(t.g),this.b=ds(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=an){return Kt.workingToColorSpace(Ve.copy(this),t),Math.round(qt(Ve.r*255,0,255))*65536+Math.round(qt(Ve.g*255,0,255))*256+Math.round(qt(Ve.b*255,0,255))}getHexString(t=an){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=Kt.workingColorSpace){Kt.workingToColorSpace(Ve.copy(this),e);let n=Ve.r,s=Ve.g,r=Ve.b,o=Math.max(n,s,r),a=Math.min(n,s,r),l,c,h=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=h<=.5?u/(o+a):u/(2-o-a),o){case n:l=(s-r)/u+(s<r?6:0);break;case s:l=(r-n)/u+2;break;case r:l=(n-s)/u+4;break}l/=6}return t.h=l,t.s=c,t.l=h,t}getRGB(t,e=Kt.workingColorSpace){return Kt.workingToColorSpace(Ve.copy(this),e),t.r=Ve.r,t.g=Ve.g,t.b=Ve.b,t}getStyle(t=an){Kt.workingToColorSpace(Ve.copy(this),t);let e=Ve.r,n=Ve.g,s=Ve.b;return t!==an?`color(${t} ${e.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(t,e,n){return this.getHSL(mi),this.setHSL(mi.h+t,mi.s+e,mi.l+n)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,n){return this.r=t.r+(e.r-t.r)*n,this.g=t.g+(e.g-t.g)*n,this.b=t.b+(e.b-t.b)*n,this}lerpHSL(t,e){this.getHSL(mi),t.getHSL(ro);let n=js(mi.h,ro.h,e),s=js(mi.s,ro.s,e),r=js(mi.l,ro.l,e);return this.setHSL(n,s,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){let e=this.r,n=this.g,s=this.b,r=t.elements;return this.r=r[0]*e+r[3]*n+r[6]*s,this.g=r[1]*e+r[4]*n+r[7]*s,this.b=r[2]*e+r[5]*n+r[8]*s,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},Ve=new Ut;Ut.NAMES=pf;var rr=class extends hn{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new vi,this.environmentIntensity=1,this.environmentRotation=new vi,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),this.background=t.background!==null?t.background.clone():null,this.environment=t.environment!==null?t.environment.clone():null,this.fog=t.fog!==null?t.fog.clone():null,this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),this.overrideMaterial=t.overrideMaterial!==null?t.overrideMaterial.clone():null,this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){let e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),e.object.backgroundBlurriness=this.backgroundBlurriness,e.object.backgroundIntensity=this.backgroundIntensity,e.object.backgroundRotation=this.backgroundRotation.toArray(),e.object.environmentIntensity=this.environmentIntensity,e.object.environmentRotation=this.environmentRotation.toArray(),e}},En=new N,Kn=new N,xc=new N,jn=new N,is=new N,ss=new N,ud=new N,yc=new N,vc=new N,Mc=new N,bc=new ge,Sc=new ge,wc=new ge,yi=class i{constructor(t=new N,e=new N,n=new N){this.a=t,this.b=e,this.c=n}static getNormal(t,e,n,s){s.subVectors(n,e),En.subVectors(t,e),s.cross(En);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(t,e,n,s,r){En.subVectors(s,e),Kn.subVectors(n,e),xc.subVectors(t,e);let o=En.dot(En),a=En.dot(Kn),l=En.dot(xc),c=Kn.dot(Kn),h=Kn.dot(xc),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let d=1/u,f=(c*l-a*h)*d,m=(o*h-a*l)*d;return r.set(1-f-m,m,f)}static containsPoint(t,e,n,s){return this.getBarycoord(t,e,n,s,jn)===null?!1:jn.x>=0&&jn.y>=0&&jn.x+jn.y<=1}static getInterpolation(t,e,n,s,r,o,a,l){return this.getBarycoord(t,e,n,s,jn)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,jn.x),l.addScaledVector(o,jn.y),l.addScaledVector(a,jn.z),l)}static getInterpolatedAttribute(t,e,n,s,r,o){return bc.setScalar(0),Sc.setScalar(0),wc.setScalar(0),bc.fromBufferAttribute(t,e),Sc.fromBufferAttribute(t,n),wc.fromBufferAttribute(t,s),o.setScalar(0),o.addScaledVector(bc,r.x),o.addScaledVector(Sc,r.y),o.addScaledVector(wc,r.z),o}static isFrontFacing(t,e,n,s){return En.subVectors(n,e),Kn.subVectors(t,e),En.cross(Kn).dot(s)<0}set(t,e,n){return this.a.copy(t),this.b.copy(e),this.c.copy(n),this}setFromPointsAndIndices(t,e,n,s){return this.a.copy(t[e]),this.b.copy(t[n]),this.c.copy(t[s]),this}setFromAttributeAndIndices(t,e,n,s){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,n),this.c.fromBufferAttribute(t,s),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return En.subVectors(this.c,this.b),Kn.subVectors(this.a,this.b),En.cross(Kn).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return i.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return i.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,n,s,r){return i.getInterpolation(t,this.a,this.b,this.c,e,n,s,r)}containsPoint(t){return i.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return i.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){let n=this.a,s=this.b,r=this.c,o,a;is.subVectors(s,n),ss.subVectors(r,n),yc.subVectors(t,n);let l=is.dot(yc),c=ss.dot(yc);if(l<=0&&c<=0)return e.copy(n);vc.subVectors(t,s);let h=is.dot(vc),u=ss.dot(vc);if(h>=0&&u<=h)return e.copy(s);let d=l*u-h*c;if(d<=0&&l>=0&&h<=0&&l-h>0)return o=l/(l-h),e.copy(n).addScaledVector(is,o);Mc.subVectors(t,r);let f=is.dot(Mc),m=ss.dot(Mc);if(m>=0&&f<=m)return e.copy(r);let x=f*c-l*m;if(x<=0&&c>=0&&m<=0)return a=c/(c-m),e.copy(n).addScaledVector(ss,a);let p=h*m-f*u;if(p<=0&&u-h>=0&&f-m>=0)return ud.subVectors(r,s),a=(u-h)/(u-h+(f-m)),e.copy(s).addScaledVector(ud,a);let g=1/(p+x+d);return o=x*g,a=d*g,e.copy(n).addScaledVector(is,o).addScaledVector(ss,a)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}},Rn=class{constructor(t=new N(1/0,1/0,1/0),e=new N(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e+=3)this.expandByPoint(Tn.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,n=t.count;e<n;e++)this.expandByPoint(Tn.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){let n=Tn.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(n),this.max.copy(t).add(n),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);let n=t.geometry;if(n!==void 0){let r=n.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0&&t.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)t.isMesh===!0?t.getVertexPosition(o,Tn):Tn.fromBufferAttribute(r,o),Tn.applyMatrix4(t.matrixWorld),this.expandByPoint(Tn);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),oo.copy(t.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),oo.copy(n.boundingBox)),oo.applyMatrix4(t.matrixWorld),this.union(oo)}let s=t.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,Tn),Tn.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,n;return t.normal.x>0?(e=t.normal.x*this.min.x,n=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,n=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,n+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,n+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,n+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,n+=t.normal.z*this.min.z),e<=-t.constant&&n>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(qs),ao.subVectors(this.max,qs),rs.subVectors(t.a,qs),os.subVectors(t.b,qs),as.subVectors(t.c,qs),gi.subVectors(os,rs),_i.subVectors(as,os),Fi.subVectors(rs,as);let e=[0,-gi.z,gi.y,0,-_i.z,_i.y,0,-Fi.z,Fi.y,gi.z,0,-gi.x,_i.z,0,-_i.x,Fi.z,0,-Fi.x,-gi.y,gi.x,0,-_i.y,_i.x,0,-Fi.y,Fi.x,0];return!Ec(e,rs,os,as,ao)||(e=[1,0,0,0,1,0,0,0,1],!Ec(e,rs,os,as,ao))?!1:(lo.crossVectors(gi,_i),e=[lo.x,lo.y,lo.z],Ec(e,rs,os,as,ao))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,Tn).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(Tn).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(Qn[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),Qn[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),Qn[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),Qn[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),Qn[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),Qn[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),Qn[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),Qn[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(Qn),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(t){return this.min.fromArray(t.min),this.max.fromArray(t.max),this}},Qn=[new N,new N,new N,new N,new N,new N,new N,new N],Tn=new N,oo=new Rn,rs=new N,os=new N,as=new N,gi=new N,_i=new N,Fi=new N,qs=new N,ao=new N,lo=new N,Bi=new N;function Ec(i,t,e,n,s){for(let r=0,o=i.length-3;r<=o;r+=3){Bi.fromArray(i,r);let a=s.x*Math.abs(Bi.x)+s.y*Math.abs(Bi.y)+s.z*Math.abs(Bi.z),l=t.dot(Bi),c=e.dot(Bi),h=n.dot(Bi);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}var we=new N,co=new It,Ig=0,ye=class extends An{constructor(t,e,n=!1){if(super(),Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:Ig++}),this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=n,this.usage=af,this.updateRanges=[],this.gpuType=pn,this.version=0,this._normalizationScale=t!==void 0?_h(t):void 0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this._normalizationScale=t._normalizationScale,this}copyAt(t,e,n){t*=this.itemSize,n*=e.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[t+s]=e.array[n+s];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,n=this.count;e<n;e++)co.fromBufferAttribute(this,e),co.applyMatrix3(t),this.setXY(e,co.x,co.y);else if(this.itemSize===3)for(let e=0,n=this.count;e<n;e++)we.fromBufferAttribute(this,e),we.applyMatrix3(t),this.setXYZ(e,we.x,we.y,we.z);return this}applyMatrix4(t){for(let e=0,n=this.count;e<n;e++)we.fromBufferAttribute(this,e),we.applyMatrix4(t),this.setXYZ(e,we.x,we.y,we.z);return this}applyNormalMatrix(t){for(let e=0,n=this.count;e<n;e++)we.fromBufferAttribute(this,e),we.applyNormalMatrix(t),this.setXYZ(e,we.x,we.y,we.z);return this}transformDirection(t){for(let e=0,n=this.count;e<n;e++)we.fromBufferAttribute(this,e),we.transformDirection(t),this.setXYZ(e,we.x,we.y,we.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let n=this.array[t*this.itemSize+e];return this.normalized&&(n=this._denormalize(n)),n}setComponent(t,e,n){return this.normalized&&(n=this._normalize(n)),this.array[t*this.itemSize+e]=n,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=this._denormalize(e)),e}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=this._denormalize(e)),e}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=this._denormalize(e)),e}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=this._denormalize(e)),e}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,n){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n)),this.array[t+0]=e,this.array[t+1]=n,this}setXYZ(t,e,n,s){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n),s=this._normalize(s)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this}setXYZW(t,e,n,s,r){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return t.name=this.name,t.usage=this.usage,t.gpuType=this.gpuType,t}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):df(t,this.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):ff(t,this.array)}};var or=class extends ye{constructor(t,e,n){super(new Uint16Array(t),e,n)}};var ar=class extends ye{constructor(t,e,n){super(new Uint32Array(t),e,n)}};var qe=class extends ye{constructor(t,e,n){super(new Float32Array(t),e,n)}},Lg=new Rn,$s=new N,Tc=new N,un=class{constructor(t=new N,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){let n=this.center;e!==void 0?n.copy(e):Lg.setFromPoints(t).getCenter(n);let s=0;for(let r=0,o=t.length;r<o;r++)s=Math.max(s,n.distanceToSquared(t[r]));return this.radius=Math.sqrt(s),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){let e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){let n=this.center.distanceToSquared(t);return e.copy(t),n>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;$s.subVectors(t,this.center);let e=$s.lengthSq();if(e>this.radius*this.radius){let n=Math.sqrt(e),s=(n-this.radius)*.5;this.center.addScaledVector($s,s/n),this.radius+=s}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(Tc.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint($s.copy(t.center).add(Tc)),this.expandByPoint($s.copy(t.center).sub(Tc))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(t){return this.radius=t.radius,this.center.fromArray(t.center),this}},Dg=0,vn=new Qt,Ac=new hn,ls=new N,on=new Rn,Ys=new Rn,De=new N,Ye=class i extends An{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:Dg++}),this.uuid=As(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(sg(t)?ar:or)(t,1):this.index=t,this}setIndirect(t,e=0){return this.indirect=t,this.indirectOffset=e,this}getIndirect(){return this.indirect}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,n=0){this.groups.push({start:t,count:e,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){let e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);let n=this.attributes.normal;if(n!==void 0){let r=new Ot().getNormalMatrix(t);n.applyNormalMatrix(r),n.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(t),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(t){return vn.makeRotationFromQuaternion(t),this.applyMatrix4(vn),this}rotateX(t){return vn.makeRotationX(t),this.applyMatrix4(vn),this}rotateY(t){return vn.makeRotationY(t),this.applyMatrix4(vn),this}rotateZ(t){return vn.makeRotationZ(t),this.applyMatrix4(vn),this}translate(t,e,n){return vn.makeTranslation(t,e,n),this.applyMatrix4(vn),this}scale(t,e,n){return vn.makeScale(t,e,n),this.applyMatrix4(vn),this}lookAt(t){return Ac.lookAt(t),Ac.updateMatrix(),this.applyMatrix4(Ac.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(ls).negate(),this.translate(ls.x,ls.y,ls.z),this}setFromPoints(t){let e=this.getAttribute("position");if(e===void 0){let n=[];for(let s=0,r=t.length;s<r;s++){let o=t[s];n.push(o.x,o.y,o.z||0)}this.setAttribute("position",new qe(n,3))}else{let n=Math.min(t.length,e.count);for(let s=0;s<n;s++){let r=t[s];e.setXYZ(s,r.x,r.y,r.z||0)}t.length>e.count&&Lt("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),e.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Rn);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Nt("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new N(-1/0,-1/0,-1/0),new N(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let n=0,s=e.length;n<s;n++){let r=e[n];on.setFromBufferAttribute(r),this.morphTargetsRelative?(De.addVectors(this.boundingBox.min,on.min),this.boundingBox.expandByPoint(De),De.addVectors(this.boundingBox.max,on.max),this.boundingBox.expandByPoint(De)):(this.boundingBox.expandByPoint(on.min),this.boundingBox.expandByPoint(on.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&Nt('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new un);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Nt("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new N,1/0);return}if(t){let n=this.boundingSphere.center;if(on.setFromBufferAttribute(t),e)for(let r=0,o=e.length;r<o;r++){let a=e[r];Ys.setFromBufferAttribute(a),this.morphTargetsRelative?(De.addVectors(on.min,Ys.min),on.expandByPoint(De),De.addVectors(on.max,Ys.max),on.expandByPoint(De)):(on.expandByPoint(Ys.min),on.expandByPoint(Ys.max))}on.getCenter(n);let s=0;for(let r=0,o=t.count;r<o;r++)De.fromBufferAttribute(t,r),s=Math.max(s,n.distanceToSquared(De));if(e)for(let r=0,o=e.length;r<o;r++){let a=e[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)De.fromBufferAttribute(a,c),l&&(ls.fromBufferAttribute(t,c),De.add(ls)),s=Math.max(s,n.distanceToSquared(De))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&Nt('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){Nt("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let n=e.position,s=e.normal,r=e.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==n.count)&&(o=new ye(new Float32Array(4*n.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(n.count);for(let k=0;k<n.count;k++)a[k]=new N,l[k]=new N;let h=new N,u=new N,d=new N,f=new It,m=new It,x=new It,p=new N,g=new N;function S(k,L,O){c[k]=c[L]=c[O]=1,h.fromBufferAttribute(n,k),u.fromBufferAttribute(n,L),d.fromBufferAttribute(n,O),f.fromBufferAttribute(r,k),m.fromBufferAttribute(r,L),x.fromBufferAttribute(r,O),u.sub(h),d.sub(h),m.sub(f),x.sub(f);let V=1/(m.x*x.y-x.x*m.y);isFinite(V)&&(p.copy(u).multiplyScalar(x.y).addScaledVector(d,-m.y).multiplyScalar(V),g.copy(d).multiplyScalar(m.x).addScaledVector(u,-x.x).multiplyScalar(V),a[k].add(p),a[L].add(p),a[O].add(p),l[k].add(g),l[L].add(g),l[O].add(g))}let w=this.groups;w.length===0&&(w=[{start:0,count:t.count}]);for(let k=0,L=w.length;k<L;++k){let O=w[k],V=O.start,Y=O.count;for(let I=V,q=V+Y;I<q;I+=3)S(t.getX(I+0),t.getX(I+1),t.getX(I+2))}let b=new N,R=new N,A=new N,_=new N;function E(k){A.fromBufferAttribute(s,k),_.copy(A);let L=a[k];b.copy(L),b.sub(A.multiplyScalar(A.dot(L))).normalize(),R.crossVectors(_,L);let V=R.dot(l[k])<0?-1:1;o.setXYZW(k,b.x,b.y,b.z,V)}for(let k=0,L=n.count;k<L;++k)c[k]&&E(k);this._transformed=!0}computeVertexNormals(){let t=this.index,e=this.getAttribute("position");if(e!==void 0){let n=this.getAttribute("normal");if(n===void 0||n.count!==e.count)n=new ye(new Float32Array(e.count*3),3),this.setAttribute("normal",n);else for(let d=0,f=n.count;d<f;d++)n.setXYZ(d,0,0,0);let s=new N,r=new N,o=new N,a=new N,l=new N,c=new N,h=new N,u=new N;if(t)for(let d=0,f=t.count;d<f;d+=3){let m=t.getX(d+0),x=t.getX(d+1),p=t.getX(d+2);s.fromBufferAttribute(e,m),r.fromBufferAttribute(e,x),o.fromBufferAttribute(e,p),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),a.fromBufferAttribute(n,m),l.fromBufferAttribute(n,x),c.fromBufferAttribute(n,p),a.add(h),l.add(h),c.add(h),n.setXYZ(m,a.x,a.y,a.z),n.setXYZ(x,l.x,l.y,l.z),n.setXYZ(p,c.x,c.y,c.z)}else for(let d=0,f=e.count;d<f;d+=3)s.fromBufferAttribute(e,d+0),r.fromBufferAttribute(e,d+1),o.fromBufferAttribute(e,d+2),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),n.setXYZ(d+0,h.x,h.y,h.z),n.setXYZ(d+1,h.x,h.y,h.z),n.setXYZ(d+2,h.x,h.y,h.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){let t=this.attributes.normal;for(let e=0,n=t.count;e<n;e++)De.fromBufferAttribute(t,e),De.normalize(),t.setXYZ(e,De.x,De.y,De.z)}toNonIndexed(){function t(a,l){let c=a.array,h=a.itemSize,u=a.normalized,d=new c.constructor(l.length*h),f=0,m=0;for(let x=0,p=l.length;x<p;x++){a.isInterleavedBufferAttribute?f=l[x]*a.data.stride+a.offset:f=l[x]*h;for(let g=0;g<h;g++)d[m++]=c[f++]}return new ye(d,h,u)}if(this.index===null)return Lt("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let e=new i,n=this.index.array,s=this.attributes;for(let a in s){let l=s[a],c=t(l,n);e.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let h=0,u=c.length;h<u;h++){let d=c[h],f=t(d,n);l.push(f)}e.morphAttributes[a]=l}e.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];e.addGroup(c.start,c.count,c.materialIndex)}return e}toJSON(){let t={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,t.name=this.name,Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(t[c]=l[c]);return t}t.data={attributes:{}};let e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});let n=this.attributes;for(let l in n){let c=n[l];t.data.attributes[l]=c.toJSON(t.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,d=c.length;u<d;u++){let f=c[u];h.push(f.toJSON(t.data))}h.length>0&&(s[l]=h,r=!0)}r&&(t.data.morphAttributes=s,t.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(t.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(t.data.boundingSphere=a.toJSON()),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let e={};this.name=t.name;let n=t.index;n!==null&&this.setIndex(n.clone());let s=t.attributes;for(let c in s){let h=s[c];this.setAttribute(c,h.clone(e))}let r=t.morphAttributes;for(let c in r){let h=[],u=r[c];for(let d=0,f=u.length;d<f;d++)h.push(u[d].clone(e));this.morphAttributes[c]=h}this.morphTargetsRelative=t.morphTargetsRelative;let o=t.groups;for(let c=0,h=o.length;c<h;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=t.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=t.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this._transformed=t._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}};var Rc=new N,Ng=new N,Og=new Ot,We=class{constructor(t=new N(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,n,s){return this.normal.set(t,e,n),this.constant=s,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,n){let s=Rc.subVectors(n,e).cross(Ng.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(s,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){let t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e,n=!0){let s=t.delta(Rc),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;let o=-(t.start.dot(this.normal)+this.constant)/r;return n===!0&&(o<0||o>1)?null:e.copy(t.start).addScaledVector(s,o)}intersectsLine(t){let e=this.distanceToPoint(t.start),n=this.distanceToPoint(t.end);return e<0&&n>0||n<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){let n=e||Og.getNormalMatrix(t),s=this.coplanarPoint(Rc).applyMatrix4(t),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(t){return this.normal.fromArray(t.normal),this.constant=t.constant,this}},Ug=0,Mi=class extends An{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:Ug++}),this.uuid=As(),this.name="",this.type="Material",this.blending=ws,this.side=Gn,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=qc,this.blendDst=$c,this.blendEquation=Wi,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new Ut(0,0,0),this.blendAlpha=0,this.depthFunc=fs,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=tf,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=Co,this.stencilZFail=Co,this.stencilZPass=Co,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(let e in t){let n=t[e];if(n===void 0){Lt(`Material: parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){Lt(`Material: '${e}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector2&&n&&n.isVector2||s&&s.isEuler&&n&&n.isEuler||s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[e]=n}}toJSON(t){let e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});let n={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,n.blending=this.blending,n.side=this.side,n.shadowSide=this.shadowSide,n.vertexColors=this.vertexColors,n.opacity=this.opacity,n.transparent=this.transparent,n.blendSrc=this.blendSrc,n.blendDst=this.blendDst,n.blendEquation=this.blendEquation,n.blendSrcAlpha=this.blendSrcAlpha,n.blendDstAlpha=this.blendDstAlpha,n.blendEquationAlpha=this.blendEquationAlpha,n.blendColor=this.blendColor.getHex(),n.blendAlpha=this.blendAlpha,n.depthFunc=this.depthFunc,n.depthTest=this.depthTest,n.depthWrite=this.depthWrite,n.colorWrite=this.colorWrite,n.clipIntersection=this.clipIntersection,n.clipShadows=this.clipShadows,n.stencilWriteMask=this.stencilWriteMask,n.stencilFunc=this.stencilFunc,n.stencilRef=this.stencilRef,n.stencilFuncMask=this.stencilFuncMask,n.stencilFail=this.stencilFail,n.stencilZFail=this.stencilZFail,n.stencilZPass=this.stencilZPass,n.stencilWrite=this.stencilWrite,n.polygonOffset=this.polygonOffset,n.polygonOffsetFactor=this.polygonOffsetFactor,n.polygonOffsetUnits=this.polygonOffsetUnits,n.dithering=this.dithering,n.alphaTest=this.alphaTest,n.alphaHash=this.alphaHash,n.alphaToCoverage=this.alphaToCoverage,n.premultipliedAlpha=this.premultipliedAlpha,n.forceSinglePass=this.forceSinglePass,n.allowOverride=this.allowOverride,n.visible=this.visible,n.toneMapped=this.toneMapped,n.name=this.name,this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(n.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(n.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(t).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(n.sheenColorMap=this.sheenColorMap.toJSON(t).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(n.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(t).uuid),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(n.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(n.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(n.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(t).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(t).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(t).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(t).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(t).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(n.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(n.rotation=this.rotation),this.depthPacking!==void 0&&(n.depthPacking=this.depthPacking),this.linewidth!==void 0&&(n.linewidth=this.linewidth),this.linecap!==void 0&&(n.linecap=this.linecap),this.linejoin!==void 0&&(n.linejoin=this.linejoin),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.wireframe!==void 0&&(n.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(n.flatShading=this.flatShading),this.fog!==void 0&&(n.fog=this.fog),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(e){let r=s(t.textures),o=s(t.images);r.length>0&&(n.textures=r),o.length>0&&(n.images=o)}return n}fromJSON(t,e){if(t.uuid!==void 0&&(this.uuid=t.uuid),t.name!==void 0&&(this.name=t.name),t.color!==void 0&&this.color!==void 0&&this.color.setHex(t.color),t.roughness!==void 0&&(this.roughness=t.roughness),t.metalness!==void 0&&(this.metalness=t.metalness),t.sheen!==void 0&&(this.sheen=t.sheen),t.sheenColor!==void 0&&(this.sheenColor=new Ut().setHex(t.sheenColor)),t.sheenRoughness!==void 0&&(this.sheenRoughness=t.sheenRoughness),t.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(t.emissive),t.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(t.specular),t.specularIntensity!==void 0&&(this.specularIntensity=t.specularIntensity),t.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(t.specularColor),t.shininess!==void 0&&(this.shininess=t.shininess),t.clearcoat!==void 0&&(this.clearcoat=t.clearcoat),t.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=t.clearcoatRoughness),t.diffuseRoughness!==void 0&&(this.diffuseRoughness=t.diffuseRoughness),t.dispersion!==void 0&&(this.dispersion=t.dispersion),t.retroreflectivity!==void 0&&(this.retroreflectivity=t.retroreflectivity),t.iridescence!==void 0&&(this.iridescence=t.iridescence),t.iridescenceIOR!==void 0&&(this.iridescenceIOR=t.iridescenceIOR),t.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessMinimum),t.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=t.iridescenceThicknessMaximum),t.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=t.iridescenceThicknessRange[1]),t.transmission!==void 0&&(this.transmission=t.transmission),t.thickness!==void 0&&(this.thickness=t.thickness),t.attenuationDistance!==void 0&&(this.attenuationDistance=t.attenuationDistance),t.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(t.attenuationColor),t.anisotropy!==void 0&&(this.anisotropy=t.anisotropy),t.anisotropyRotation!==void 0&&(this.anisotropyRotation=t.anisotropyRotation),t.fog!==void 0&&(this.fog=t.fog),t.flatShading!==void 0&&(this.flatShading=t.flatShading),t.blending!==void 0&&(this.blending=t.blending),t.combine!==void 0&&(this.combine=t.combine),t.side!==void 0&&(this.side=t.side),t.shadowSide!==void 0&&(this.shadowSide=t.shadowSide),t.opacity!==void 0&&(this.opacity=t.opacity),t.transparent!==void 0&&(this.transparent=t.transparent),t.alphaTest!==void 0&&(this.alphaTest=t.alphaTest),t.alphaHash!==void 0&&(this.alphaHash=t.alphaHash),t.depthFunc!==void 0&&(this.depthFunc=t.depthFunc),t.depthTest!==void 0&&(this.depthTest=t.depthTest),t.depthWrite!==void 0&&(this.depthWrite=t.depthWrite),t.colorWrite!==void 0&&(this.colorWrite=t.colorWrite),t.clippingPlanes!==void 0&&(this.clippingPlanes=t.clippingPlanes.map(n=>new We().fromJSON(n))),t.clipIntersection!==void 0&&(this.clipIntersection=t.clipIntersection),t.clipShadows!==void 0&&(this.clipShadows=t.clipShadows),t.depthPacking!==void 0&&(this.depthPacking=t.depthPacking),t.blendSrc!==void 0&&(this.blendSrc=t.blendSrc),t.blendDst!==void 0&&(this.blendDst=t.blendDst),t.blendEquation!==void 0&&(this.blendEquation=t.blendEquation),t.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=t.blendSrcAlpha),t.blendDstAlpha!==void 0&&(this.blendDstAlpha=t.blendDstAlpha),t.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=t.blendEquationAlpha),t.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(t.blendColor),t.blendAlpha!==void 0&&(this.blendAlpha=t.blendAlpha),t.stencilWriteMask!==void 0&&(this.stencilWriteMask=t.stencilWriteMask),t.stencilFunc!==void 0&&(this.stencilFunc=t.stencilFunc),t.stencilRef!==void 0&&(this.stencilRef=t.stencilRef),t.stencilFuncMask!==void 0&&(this.stencilFuncMask=t.stencilFuncMask),t.stencilFail!==void 0&&(this.stencilFail=t.stencilFail),t.stencilZFail!==void 0&&(this.stencilZFail=t.stencilZFail),t.stencilZPass!==void 0&&(this.stencilZPass=t.stencilZPass),t.stencilWrite!==void 0&&(this.stencilWrite=t.stencilWrite),t.wireframe!==void 0&&(this.wireframe=t.wireframe),t.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=t.wireframeLinewidth),t.wireframeLinecap!==void 0&&(this.wireframeLinecap=t.wireframeLinecap),t.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=t.wireframeLinejoin),t.rotation!==void 0&&(this.rotation=t.rotation),t.linewidth!==void 0&&(this.linewidth=t.linewidth),t.linecap!==void 0&&(this.linecap=t.linecap),t.linejoin!==void 0&&(this.linejoin=t.linejoin),t.dashSize!==void 0&&(this.dashSize=t.dashSize),t.gapSize!==void 0&&(this.gapSize=t.gapSize),t.scale!==void 0&&(this.scale=t.scale),t.polygonOffset!==void 0&&(this.polygonOffset=t.polygonOffset),t.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=t.polygonOffsetFactor),t.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=t.polygonOffsetUnits),t.dithering!==void 0&&(this.dithering=t.dithering),t.alphaToCoverage!==void 0&&(this.alphaToCoverage=t.alphaToCoverage),t.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=t.premultipliedAlpha),t.forceSinglePass!==void 0&&(this.forceSinglePass=t.forceSinglePass),t.allowOverride!==void 0&&(this.allowOverride=t.allowOverride),t.visible!==void 0&&(this.visible=t.visible),t.toneMapped!==void 0&&(this.toneMapped=t.toneMapped),t.userData!==void 0&&(this.userData=t.userData),t.vertexColors!==void 0&&(typeof t.vertexColors=="number"?this.vertexColors=t.vertexColors>0:this.vertexColors=t.vertexColors),t.size!==void 0&&(this.size=t.size),t.sizeAttenuation!==void 0&&(this.sizeAttenuation=t.sizeAttenuation),t.map!==void 0&&(this.map=e[t.map]||null),t.matcap!==void 0&&(this.matcap=e[t.matcap]||null),t.alphaMap!==void 0&&(this.alphaMap=e[t.alphaMap]||null),t.bumpMap!==void 0&&(this.bumpMap=e[t.bumpMap]||null),t.bumpScale!==void 0&&(this.bumpScale=t.bumpScale),t.normalMap!==void 0&&(this.normalMap=e[t.normalMap]||null),t.normalMapType!==void 0&&(this.normalMapType=t.normalMapType),t.normalScale!==void 0){let n=t.normalScale;Array.isArray(n)===!1&&(n=[n,n]),this.normalScale=new It().fromArray(n)}return t.displacementMap!==void 0&&(this.displacementMap=e[t.displacementMap]||null),t.displacementScale!==void 0&&(this.displacementScale=t.displacementScale),t.displacementBias!==void 0&&(this.displacementBias=t.displacementBias),t.roughnessMap!==void 0&&(this.roughnessMap=e[t.roughnessMap]||null),t.metalnessMap!==void 0&&(this.metalnessMap=e[t.metalnessMap]||null),t.emissiveMap!==void 0&&(this.emissiveMap=e[t.emissiveMap]||null),t.emissiveIntensity!==void 0&&(this.emissiveIntensity=t.emissiveIntensity),t.specularMap!==void 0&&(this.specularMap=e[t.specularMap]||null),t.specularIntensityMap!==void 0&&(this.specularIntensityMap=e[t.specularIntensityMap]||null),t.specularColorMap!==void 0&&(this.specularColorMap=e[t.specularColorMap]||null),t.envMap!==void 0&&(this.envMap=e[t.envMap]||null),t.envMapRotation!==void 0&&this.envMapRotation.fromArray(t.envMapRotation),t.envMapIntensity!==void 0&&(this.envMapIntensity=t.envMapIntensity),t.reflectivity!==void 0&&(this.reflectivity=t.reflectivity),t.refractionRatio!==void 0&&(this.refractionRatio=t.refractionRatio),t.lightMap!==void 0&&(this.lightMap=e[t.lightMap]||null),t.lightMapIntensity!==void 0&&(this.lightMapIntensity=t.lightMapIntensity),t.aoMap!==void 0&&(this.aoMap=e[t.aoMap]||null),t.aoMapIntensity!==void 0&&(this.aoMapIntensity=t.aoMapIntensity),t.gradientMap!==void 0&&(this.gradientMap=e[t.gradientMap]||null),t.clearcoatMap!==void 0&&(this.clearcoatMap=e[t.clearcoatMap]||null),t.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=e[t.clearcoatRoughnessMap]||null),t.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=e[t.clearcoatNormalMap]||null),t.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new It().fromArray(t.clearcoatNormalScale)),t.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=e[t.diffuseRoughnessMap]||null),t.iridescenceMap!==void 0&&(this.iridescenceMap=e[t.iridescenceMap]||null),t.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=e[t.iridescenceThicknessMap]||null),t.transmissionMap!==void 0&&(this.transmissionMap=e[t.transmissionMap]||null),t.thicknessMap!==void 0&&(this.thicknessMap=e[t.thicknessMap]||null),t.anisotropyMap!==void 0&&(this.anisotropyMap=e[t.anisotropyMap]||null),t.sheenColorMap!==void 0&&(this.sheenColorMap=e[t.sheenColorMap]||null),t.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=e[t.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;let e=t.clippingPlanes,n=null;if(e!==null){let s=e.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=e[r].clone()}return this.clippingPlanes=n,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.allowOverride=t.allowOverride,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}};var ti=new N,Cc=new N,ho=new N,uo=new N,kn=class{constructor(t=new N,e=new N(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,ti)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);let n=e.dot(this.direction);return n<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){let e=ti.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(ti.copy(this.origin).addScaledVector(this.direction,e),ti.distanceToSquared(t))}distanceSqToSegment(t,e,n,s){Cc.copy(t).add(e).multiplyScalar(.5),ho.copy(e).sub(t).normalize(),uo.copy(this.origin).sub(Cc);let r=t.distanceTo(e)*.5,o=-this.direction.dot(ho),a=uo.dot(this.direction),l=-uo.dot(ho),c=uo.lengthSq(),h=Math.abs(1-o*o),u,d,f,m;if(h>0)if(u=o*l-a,d=o*a-l,m=r*h,u>=0)if(d>=-m)if(d<=m){let x=1/h;u*=x,d*=x,f=u*(u+o*d+2*a)+d*(o*u+d+2*l)+c}else d=r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d=-r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d<=-m?(u=Math.max(0,-(-o*r+a)),d=u>0?-r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c):d<=m?(u=0,d=Math.min(Math.max(-r,-l),r),f=d*(d+2*l)+c):(u=Math.max(0,-(o*r+a)),d=u>0?r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c);else d=o>0?-r:r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(Cc).addScaledVector(ho,d),f}intersectSphere(t,e){if(t.radius<0)return null;ti.subVectors(t.center,this.origin);let n=ti.dot(this.direction),s=ti.dot(ti)-n*n,r=t.radius*t.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=n-o,l=n+o;return l<0?null:a<0?this.at(l,e):this.at(a,e)}intersectsSphere(t){return t.radius<0?!1:this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){let e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;let n=-(this.origin.dot(t.normal)+t.constant)/e;return n>=0?n:null}intersectPlane(t,e){let n=this.distanceToPlane(t);return n===null?null:this.at(n,e)}intersectsPlane(t){let e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let n,s,r,o,a,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,d=this.origin;return c>=0?(n=(t.min.x-d.x)*c,s=(t.max.x-d.x)*c):(n=(t.max.x-d.x)*c,s=(t.min.x-d.x)*c),h>=0?(r=(t.min.y-d.y)*h,o=(t.max.y-d.y)*h):(r=(t.max.y-d.y)*h,o=(t.min.y-d.y)*h),n>o||r>s||((r>n||isNaN(n))&&(n=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(t.min.z-d.z)*u,l=(t.max.z-d.z)*u):(a=(t.max.z-d.z)*u,l=(t.min.z-d.z)*u),n>l||a>s)||((a>n||n!==n)&&(n=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,e)}intersectsBox(t){return this.intersectBox(t,ti)!==null}intersectTriangle(t,e,n,s,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,h=a.z,u=t.x-o.x,d=t.y-o.y,f=t.z-o.z,m=e.x-o.x,x=e.y-o.y,p=e.z-o.z,g=n.x-o.x,S=n.y-o.y,w=n.z-o.z,b=Math.abs(l),R=Math.abs(c),A=Math.abs(h),_,E,k,L,O,V,Y,I,q,j,H,st;if(b>=R&&b>=A?(k=l,V=u,q=m,st=g,l>=0?(_=c,E=h,L=d,O=f,Y=x,I=p,j=S,H=w):(_=h,E=c,L=f,O=d,Y=p,I=x,j=w,H=S)):R>=A?(k=c,V=d,q=x,st=S,c>=0?(_=h,E=l,L=f,O=u,Y=p,I=m,j=w,H=g):(_=l,E=h,L=u,O=f,Y=m,I=p,j=g,H=w)):(k=h,V=f,q=p,st=w,h>=0?(_=l,E=c,L=u,O=d,Y=m,I=x,j=g,H=S):(_=c,E=l,L=d,O=u,Y=x,I=m,j=S,H=g)),k===0)return null;let X=_/k,tt=E/k,et=1/k,wt=L-X*V,Bt=O-tt*V,J=Y-X*q,_t=I-tt*q,Mt=j-X*st,Ct=H-tt*st,xt=Mt*_t-Ct*J,Vt=wt*Ct-Bt*Mt,be=J*Bt-_t*wt;if(s){if(xt<0||Vt<0||be<0)return null}else if((xt<0||Vt<0||be<0)&&(xt>0||Vt>0||be>0))return null;let Dt=xt+Vt+be;if(Dt===0)return null;let se=et*(xt*V+Vt*q+be*st);return(Dt>0?se<0:se>0)?null:this.at(se/Dt,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},Ho=class extends Mi{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new Ut(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new vi,this.combine=Yc,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}},dd=new Qt,ki=new kn,fo=new un,fd=new N,po=new N,mo=new N,go=new N,Pc=new N,_o=new N,pd=new N,xo=new N,tn=class extends hn{constructor(t=new Ye,e=new Ho){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){let e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){let s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(t,e){let n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,o=n.morphTargetsRelative;e.fromBufferAttribute(s,t);let a=this.morphTargetInfluences;if(r&&a){_o.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=a[l],u=r[l];h!==0&&(Pc.fromBufferAttribute(u,t),o?_o.addScaledVector(Pc,h):_o.addScaledVector(Pc.sub(e),h))}e.add(_o)}return e}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),fo.copy(n.boundingSphere),fo.applyMatrix4(r),ki.copy(t.ray).recast(t.near),!(fo.containsPoint(ki.origin)===!1&&(ki.intersectSphere(fo,fd)===null||ki.origin.distanceToSquared(fd)>(t.far-t.near)**2))&&(dd.copy(r).invert(),ki.copy(t.ray).applyMatrix4(dd),!(n.boundingBox!==null&&ki.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(t,e,ki)))}_computeIntersections(t,e,n){let s,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,d=r.groups,f=r.drawRange;if(a!==null)if(Array.isArray(o))for(let m=0,x=d.length;m<x;m++){let p=d[m],g=o[p.materialIndex],S=Math.max(p.start,f.start),w=Math.min(a.count,Math.min(p.start+p.count,f.start+f.count));for(let b=S,R=w;b<R;b+=3){let A=a.getX(b),_=a.getX(b+1),E=a.getX(b+2);s=yo(this,g,t,n,c,h,u,A,_,E),s&&(s.faceIndex=Math.floor(b/3),s.face.materialIndex=p.materialIndex,e.push(s))}}else{let m=Math.max(0,f.start),x=Math.min(a.count,f.start+f.count);for(let p=m,g=x;p<g;p+=3){let S=a.getX(p),w=a.getX(p+1),b=a.getX(p+2);s=yo(this,o,t,n,c,h,u,S,w,b),s&&(s.faceIndex=Math.floor(p/3),e.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let m=0,x=d.length;m<x;m++){let p=d[m],g=o[p.materialIndex],S=Math.max(p.start,f.start),w=Math.min(l.count,Math.min(p.start+p.count,f.start+f.count));for(let b=S,R=w;b<R;b+=3){let A=b,_=b+1,E=b+2;s=yo(this,g,t,n,c,h,u,A,_,E),s&&(s.faceIndex=Math.floor(b/3),s.face.materialIndex=p.materialIndex,e.push(s))}}else{let m=Math.max(0,f.start),x=Math.min(l.count,f.start+f.count);for(let p=m,g=x;p<g;p+=3){let S=p,w=p+1,b=p+2;s=yo(this,o,t,n,c,h,u,S,w,b),s&&(s.faceIndex=Math.floor(p/3),e.push(s))}}}};function Fg(i,t,e,n,s,r,o,a){let l;if(t.side===Ze?l=n.intersectTriangle(o,r,s,!0,a):l=n.intersectTriangle(s,r,o,t.side===Gn,a),l===null)return null;xo.copy(a),xo.applyMatrix4(i.matrixWorld);let c=e.ray.origin.distanceTo(xo);return c<e.near||c>e.far?null:{distance:c,point:xo.clone(),object:i}}function yo(i,t,e,n,s,r,o,a,l,c){i.getVertexPosition(a,po),i.getVertexPosition(l,mo),i.getVertexPosition(c,go);let h=Fg(i,t,e,n,po,mo,go,pd);if(h){let u=new N;yi.getBarycoord(pd,po,mo,go,u),s&&(h.uv=yi.getInterpolatedAttribute(s,a,l,c,u,new It)),r&&(h.uv1=yi.getInterpolatedAttribute(r,a,l,c,u,new It)),o&&(h.normal=yi.getInterpolatedAttribute(o,a,l,c,u,new N),h.normal.dot(n.direction)>0&&h.normal.multiplyScalar(-1));let d={a,b:l,c,normal:new N,materialIndex:0};yi.getNormal(po,mo,go,d.normal),h.face=d,h.barycoord=u}return h}var bi=class extends Qe{constructor(t=null,e=1,n=1,s,r,o,a,l,c=_e,h=_e,u,d){super(null,o,a,l,c,h,s,r,u,d),this.isDataTexture=!0,this.image={data:t,width:e,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var zi=new un,Bg=new It(.5,.5),vo=new N,Vi=class{constructor(t=new We,e=new We,n=new We,s=new We,r=new We,o=new We){this.planes=[t,e,n,s,r,o]}set(t,e,n,s,r,o){let a=this.planes;return a[0].copy(t),a[1].copy(e),a[2].copy(n),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(t){let e=this.planes;for(let n=0;n<6;n++)e[n].copy(t.planes[n]);return this}setFromProjectionMatrix(t,e=Mn,n=!1){let s=this.planes,r=t.elements,o=r[0],a=r[1],l=r[2],c=r[3],h=r[4],u=r[5],d=r[6],f=r[7],m=r[8],x=r[9],p=r[10],g=r[11],S=r[12],w=r[13],b=r[14],R=r[15];if(s[0].setComponents(c-o,f-h,g-m,R-S).normalize(),s[1].setComponents(c+o,f+h,g+m,R+S).normalize(),s[2].setComponents(c+a,f+u,g+x,R+w).normalize(),s[3].setComponents(c-a,f-u,g-x,R-w).normalize(),n)s[4].setComponents(l,d,p,b).normalize(),s[5].setComponents(c-l,f-d,g-p,R-b).normalize();else if(s[4].setComponents(c-l,f-d,g-p,R-b).normalize(),e===Mn)s[5].setComponents(c+l,f+d,g+p,R+b).normalize();else if(e===nr)s[5].setComponents(l,d,p,b).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),zi.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{let e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),zi.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(zi)}intersectsSprite(t){zi.center.set(0,0,0);let e=Bg.distanceTo(t.center);return zi.radius=.7071067811865476+e,zi.applyMatrix4(t.matrixWorld),this.intersectsSphere(zi)}intersectsSphere(t){let e=this.planes,n=t.center,s=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(t){let e=this.planes;for(let n=0;n<6;n++){let s=e[n];if(vo.x=s.normal.x>0?t.max.x:t.min.x,vo.y=s.normal.y>0?t.max.y:t.min.y,vo.z=s.normal.z>0?t.max.z:t.min.z,s.distanceToPoint(vo)<0)return!1}return!0}containsPoint(t){let e=this.planes;for(let n=0;n<6;n++)if(e[n].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},md=new Qt,Wo=class i{constructor(){this.coordinateSystem=Mn,this._frustums=[],this._count=0}setFromArrayCamera(t){let e=t.cameras,n=this._frustums;for(let s=0;s<e.length;s++){let r=e[s];md.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),n[s]===void 0&&(n[s]=new Vi),n[s].setFromProjectionMatrix(md,r.coordinateSystem,r.reversedDepth)}return this._count=e.length,this}getFrustum(t){return this._frustums[t]}intersectsObject(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsObject(t))return!0;return!1}intersectsSprite(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsSprite(t))return!0;return!1}intersectsSphere(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsSphere(t))return!0;return!1}intersectsBox(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsBox(t))return!0;return!1}containsPoint(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].containsPoint(t))return!0;return!1}copy(t){this.coordinateSystem=t.coordinateSystem;let e=this._frustums,n=t._frustums;for(let s=0;s<t._count;s++)e[s]===void 0&&(e[s]=new Vi),e[s].copy(n[s]);return this._count=t._count,this}clone(){return new i().copy(this)}};var Xo=class extends Mi{constructor(t){super(),this.isPointsMaterial=!0,this.type="PointsMaterial",this.color=new Ut(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.alphaMap=t.alphaMap,this.size=t.size,this.sizeAttenuation=t.sizeAttenuation,this.fog=t.fog,this}},gd=new Qt,Oc=new kn,Mo=new un,bo=new N,lr=class extends hn{constructor(t=new Ye,e=new Xo){super(),this.isPoints=!0,this.type="Points",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let n=this.geometry,s=this.matrixWorld,r=t.params.Points.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),Mo.copy(n.boundingSphere),Mo.applyMatrix4(s),Mo.radius+=r,t.ray.intersectsSphere(Mo)===!1)return;gd.copy(s).invert(),Oc.copy(t.ray).applyMatrix4(gd);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=n.index,u=n.attributes.position;if(c!==null){let d=Math.max(0,o.start),f=Math.min(c.count,o.start+o.count);for(let m=d,x=f;m<x;m++){let p=c.getX(m);bo.fromBufferAttribute(u,p),_d(bo,p,l,s,t,e,this)}}else{let d=Math.max(0,o.start),f=Math.min(u.count,o.start+o.count);for(let m=d,x=f;m<x;m++)bo.fromBufferAttribute(u,m),_d(bo,m,l,s,t,e,this)}}updateMorphTargets(){let e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){let s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function _d(i,t,e,n,s,r,o){let a=Oc.distanceSqToPoint(i);if(a<e){let l=new N;Oc.closestPointToPoint(i,l),l.applyMatrix4(n);let c=s.ray.origin.distanceTo(l);if(c<s.near||c>s.far)return;r.push({distance:c,distanceToRay:Math.sqrt(a),point:l,index:t,face:null,faceIndex:null,barycoord:null,object:o})}}var cr=class extends Qe{constructor(t=[],e=Xi,n,s,r,o,a,l,c,h){super(t,e,n,s,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}};var ii=class extends Qe{constructor(t,e,n=Cn,s,r,o,a=_e,l=_e,c,h=ni,u=1){if(h!==ni&&h!==ri)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let d={width:t,height:e,depth:u};super(d,s,r,o,a,l,h,n,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.source=new gs(Object.assign({},t.image)),this.compareFunction=t.compareFunction,this}toJSON(t){let e=super.toJSON(t);return e.compareFunction=this.compareFunction,e}},hr=class extends ii{constructor(t,e=Cn,n=Xi,s,r,o=_e,a=_e,l,c=ni){let h={width:t,height:t,depth:1},u=[h,h,h,h,h,h];super(t,t,e,n,s,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(t){this.image=t}},ur=class extends Qe{constructor(t=null){super(),this.sourceTexture=t,this.isExternalTexture=!0}copy(t){return super.copy(t),this.sourceTexture=t.sourceTexture,this}},ys=class i extends Ye{constructor(t=1,e=1,n=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:n,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],h=[],u=[],d=0,f=0;m("z","y","x",-1,-1,n,e,t,o,r,0),m("z","y","x",1,-1,n,e,-t,o,r,1),m("x","z","y",1,1,t,n,e,s,o,2),m("x","z","y",1,-1,t,n,-e,s,o,3),m("x","y","z",1,-1,t,e,n,s,r,4),m("x","y","z",-1,-1,t,e,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new qe(c,3)),this.setAttribute("normal",new qe(h,3)),this.setAttribute("uv",new qe(u,2));function m(x,p,g,S,w,b,R,A,_,E,k){let L=b/_,O=R/E,V=b/2,Y=R/2,I=A/2,q=_+1,j=E+1,H=0,st=0,X=new N;for(let tt=0;tt<j;tt++){let et=tt*O-Y;for(let wt=0;wt<q;wt++){let Bt=wt*L-V;X[x]=Bt*S,X[p]=et*w,X[g]=I,c.push(X.x,X.y,X.z),X[x]=0,X[p]=0,X[g]=A>0?1:-1,h.push(X.x,X.y,X.z),u.push(wt/_),u.push(1-tt/E),H+=1}}for(let tt=0;tt<E;tt++)for(let et=0;et<_;et++){let wt=d+et+q*tt,Bt=d+et+q*(tt+1),J=d+(et+1)+q*(tt+1),_t=d+(et+1)+q*tt;l.push(wt,Bt,_t),l.push(Bt,J,_t),st+=6}a.addGroup(f,st,k),f+=st,d+=H}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}};var dr=class i extends Ye{constructor(t=1,e=32,n=0,s=Math.PI*2){super(),this.type="CircleGeometry",this.parameters={radius:t,segments:e,thetaStart:n,thetaLength:s},e=Math.max(3,e);let r=[],o=[],a=[],l=[],c=new N,h=new It;o.push(0,0,0),a.push(0,0,1),l.push(.5,.5);for(let u=0,d=3;u<=e;u++,d+=3){let f=n+u/e*s;c.x=t*Math.cos(f),c.y=t*Math.sin(f),o.push(c.x,c.y,c.z),a.push(0,0,1),h.x=(o[d]/t+1)/2,h.y=(o[d+1]/t+1)/2,l.push(h.x,h.y)}for(let u=1;u<=e;u++)r.push(u,u+1,0);this.setIndex(r),this.setAttribute("position",new qe(o,3)),this.setAttribute("normal",new qe(a,3)),this.setAttribute("uv",new qe(l,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.radius,t.segments,t.thetaStart,t.thetaLength)}};function kg(i,t,e=2){let n=t&&t.length,s=n?t[0]*e:i.length,r=mf(i,0,s,e,!0),o=[];if(!r||r.next===r.prev)return o;let a,l,c;if(n&&(r=Wg(i,t,r,e)),i.length>80*e){a=i[0],l=i[1];let h=a,u=l;for(let d=e;d<s;d+=e){let f=i[d],m=i[d+1];f<a&&(a=f),m<l&&(l=m),f>h&&(h=f),m>u&&(u=m)}c=Math.max(h-a,u-l),c=c!==0?32767/c:0}return fr(r,o,e,a,l,c,0),o}function mf(i,t,e,n,s){let r;if(s===e0(i,t,e,n)>0)for(let o=t;o<e;o+=n)r=xd(o/n|0,i[o],i[o+1],r);else for(let o=e-n;o>=t;o-=n)r=xd(o/n|0,i[o],i[o+1],r);return r&&vs(r,r.next)&&(mr(r),r=r.next),r}function Gi(i,t){if(!i)return i;t||(t=i);let e=i,n;do if(n=!1,!e.steiner&&(vs(e,e.next)||me(e.prev,e,e.next)===0)){if(mr(e),e=t=e.prev,e===e.next)break;n=!0}else e=e.next;while(n||e!==t);return t}function fr(i,t,e,n,s,r,o){if(!i)return;!o&&r&&Zg(i,n,s,r);let a=i;for(;i.prev!==i.next;){let l=i.prev,c=i.next;if(r?Vg(i,n,s,r):zg(i)){t.push(l.i,i.i,c.i),mr(i),i=c.next,a=c.next;continue}if(i=c,i===a){o?o===1?(i=Gg(Gi(i),t),fr(i,t,e,n,s,r,2)):o===2&&Hg(i,t,e,n,s,r):fr(Gi(i),t,e,n,s,r,1);break}}}function zg(i){let t=i.prev,e=i,n=i.next;if(me(t,e,n)>=0)return!1;let s=t.x,r=e.x,o=n.x,a=t.y,l=e.y,c=n.y,h=Math.min(s,r,o),u=Math.min(a,l,c),d=Math.max(s,r,o),f=Math.max(a,l,c),m=n.next;for(;m!==t;){if(m.x>=h&&m.x<=d&&m.y>=u&&m.y<=f&&Zs(s,a,r,l,o,c,m.x,m.y)&&me(m.prev,m,m.next)>=0)return!1;m=m.next}return!0}function Vg(i,t,e,n){let s=i.prev,r=i,o=i.next;if(me(s,r,o)>=0)return!1;let a=s.x,l=r.x,c=o.x,h=s.y,u=r.y,d=o.y,f=Math.min(a,l,c),m=Math.min(h,u,d),x=Math.max(a,l,c),p=Math.max(h,u,d),g=Uc(f,m,t,e,n),S=Uc(x,p,t,e,n),w=i.prevZ,b=i.nextZ;for(;w&&w.z>=g&&b&&b.z<=S;){if(w.x>=f&&w.x<=x&&w.y>=m&&w.y<=p&&w!==s&&w!==o&&Zs(a,h,l,u,c,d,w.x,w.y)&&me(w.prev,w,w.next)>=0||(w=w.prevZ,b.x>=f&&b.x<=x&&b.y>=m&&b.y<=p&&b!==s&&b!==o&&Zs(a,h,l,u,c,d,b.x,b.y)&&me(b.prev,b,b.next)>=0))return!1;b=b.nextZ}for(;w&&w.z>=g;){if(w.x>=f&&w.x<=x&&w.y>=m&&w.y<=p&&w!==s&&w!==o&&Zs(a,h,l,u,c,d,w.x,w.y)&&me(w.prev,w,w.next)>=0)return!1;w=w.prevZ}for(;b&&b.z<=S;){if(b.x>=f&&b.x<=x&&b.y>=m&&b.y<=p&&b!==s&&b!==o&&Zs(a,h,l,u,c,d,b.x,b.y)&&me(b.prev,b,b.next)>=0)return!1;b=b.nextZ}return!0}function Gg(i,t){let e=i;do{let n=e.prev,s=e.next.next;!vs(n,s)&&_f(n,e,e.next,s)&&pr(n,s)&&pr(s,n)&&(t.push(n.i,e.i,s.i),mr(e),mr(e.next),e=i=s),e=e.next}while(e!==i);return Gi(e)}function Hg(i,t,e,n,s,r){let o=i;do{let a=o.next.next;for(;a!==o.prev;){if(o.i!==a.i&&jg(o,a)){let l=xf(o,a);o=Gi(o,o.next),l=Gi(l,l.next),fr(o,t,e,n,s,r,0),fr(l,t,e,n,s,r,0);return}a=a.next}o=o.next}while(o!==i)}function Wg(i,t,e,n){let s=[];for(let r=0,o=t.length;r<o;r++){let a=t[r]*n,l=r<o-1?t[r+1]*n:i.length,c=mf(i,a,l,n,!1);c===c.next&&(c.steiner=!0),s.push(Kg(c))}s.sort(Xg);for(let r=0;r<s.length;r++)e=qg(s[r],e);return e}function Xg(i,t){let e=i.x-t.x;if(e===0&&(e=i.y-t.y,e===0)){let n=(i.next.y-i.y)/(i.next.x-i.x),s=(t.next.y-t.y)/(t.next.x-t.x);e=n-s}return e}function qg(i,t){let e=$g(i,t);if(!e)return t;let n=xf(e,i);return Gi(n,n.next),Gi(e,e.next)}function $g(i,t){let e=t,n=i.x,s=i.y,r=-1/0,o;if(vs(i,e))return e;do{if(vs(i,e.next))return e.next;if(s<=e.y&&s>=e.next.y&&e.next.y!==e.y){let u=e.x+(s-e.y)*(e.next.x-e.x)/(e.next.y-e.y);if(u<=n&&u>r&&(r=u,o=e.x<e.next.x?e:e.next,u===n))return o}e=e.next}while(e!==t);if(!o)return null;let a=o,l=o.x,c=o.y,h=1/0;e=o;do{if(n>=e.x&&e.x>=l&&n!==e.x&&gf(s<c?n:r,s,l,c,s<c?r:n,s,e.x,e.y)){let u=Math.abs(s-e.y)/(n-e.x);pr(e,i)&&(u<h||u===h&&(e.x>o.x||e.x===o.x&&Yg(o,e)))&&(o=e,h=u)}e=e.next}while(e!==a);return o}function Yg(i,t){return me(i.prev,i,t.prev)<0&&me(t.next,i,i.next)<0}function Zg(i,t,e,n){let s=i;do s.z===0&&(s.z=Uc(s.x,s.y,t,e,n)),s.prevZ=s.prev,s.nextZ=s.next,s=s.next;while(s!==i);s.prevZ.nextZ=null,s.prevZ=null,Jg(s)}function Jg(i){let t,e=1;do{let n=i,s;i=null;let r=null;for(t=0;n;){t++;let o=n,a=0;for(let c=0;c<e&&(a++,o=o.nextZ,!!o);c++);let l=e;for(;a>0||l>0&&o;)a!==0&&(l===0||!o||n.z<=o.z)?(s=n,n=n.nextZ,a--):(s=o,o=o.nextZ,l--),r?r.nextZ=s:i=s,s.prevZ=r,r=s;n=o}r.nextZ=null,e*=2}while(t>1);return i}function Uc(i,t,e,n,s){return i=(i-e)*s|0,t=(t-n)*s|0,i=(i|i<<8)&16711935,i=(i|i<<4)&252645135,i=(i|i<<2)&858993459,i=(i|i<<1)&1431655765,t=(t|t<<8)&16711935,t=(t|t<<4)&252645135,t=(t|t<<2)&858993459,t=(t|t<<1)&1431655765,i|t<<1}function Kg(i){let t=i,e=i;do(t.x<e.x||t.x===e.x&&t.y<e.y)&&(e=t),t=t.next;while(t!==i);return e}function gf(i,t,e,n,s,r,o,a){return(s-o)*(t-a)>=(i-o)*(r-a)&&(i-o)*(n-a)>=(e-o)*(t-a)&&(e-o)*(r-a)>=(s-o)*(n-a)}function Zs(i,t,e,n,s,r,o,a){return!(i===o&&t===a)&&gf(i,t,e,n,s,r,o,a)}function jg(i,t){return i.next.i!==t.i&&i.prev.i!==t.i&&!Qg(i,t)&&(pr(i,t)&&pr(t,i)&&t0(i,t)&&(me(i.prev,i,t.prev)||me(i,t.prev,t))||vs(i,t)&&me(i.prev,i,i.next)>0&&me(t.prev,t,t.next)>0)}function me(i,t,e){return(t.y-i.y)*(e.x-t.x)-(t.x-i.x)*(e.y-t.y)}function vs(i,t){return i.x===t.x&&i.y===t.y}function _f(i,t,e,n){let s=wo(me(i,t,e)),r=wo(me(i,t,n)),o=wo(me(e,n,i)),a=wo(me(e,n,t));return!!(s!==r&&o!==a||s===0&&So(i,e,t)||r===0&&So(i,n,t)||o===0&&So(e,i,n)||a===0&&So(e,t,n))}function So(i,t,e){return t.x<=Math.max(i.x,e.x)&&t.x>=Math.min(i.x,e.x)&&t.y<=Math.max(i.y,e.y)&&t.y>=Math.min(i.y,e.y)}function wo(i){return i>0?1:i<0?-1:0}function Qg(i,t){let e=i;do{if(e.i!==i.i&&e.next.i!==i.i&&e.i!==t.i&&e.next.i!==t.i&&_f(e,e.next,i,t))return!0;e=e.next}while(e!==i);return!1}function pr(i,t){return me(i.prev,i,i.next)<0?me(i,t,i.next)>=0&&me(i,i.prev,t)>=0:me(i,t,i.prev)<0||me(i,i.next,t)<0}function t0(i,t){let e=i,n=!1,s=(i.x+t.x)/2,r=(i.y+t.y)/2;do e.y>r!=e.next.y>r&&e.next.y!==e.y&&s<(e.next.x-e.x)*(r-e.y)/(e.next.y-e.y)+e.x&&(n=!n),e=e.next;while(e!==i);return n}function xf(i,t){let e=Fc(i.i,i.x,i.y),n=Fc(t.i,t.x,t.y),s=i.next,r=t.prev;return i.next=t,t.prev=i,e.next=s,s.prev=e,n.next=e,e.prev=n,r.next=n,n.prev=r,n}function xd(i,t,e,n){let s=Fc(i,t,e);return n?(s.next=n.next,s.prev=n,n.next.prev=s,n.next=s):(s.prev=s,s.next=s),s}function mr(i){i.next.prev=i.prev,i.prev.next=i.next,i.prevZ&&(i.prevZ.nextZ=i.nextZ),i.nextZ&&(i.nextZ.prevZ=i.prevZ)}function Fc(i,t,e){return{i,x:t,y:e,prev:null,next:null,z:0,prevZ:null,nextZ:null,steiner:!1}}function e0(i,t,e,n){let s=0;for(let r=t,o=e-n;r<e;r+=n)s+=(i[o]-i[r])*(i[r+1]+i[o+1]),o=r;return s}var Bc=class{static triangulate(t,e,n=2){return kg(t,e,n)}},Si=class i{static area(t){let e=t.length,n=0;for(let s=e-1,r=0;r<e;s=r++)n+=t[s].x*t[r].y-t[r].x*t[s].y;return n*.5}static isClockWise(t){return i.area(t)<0}static triangulateShape(t,e){let n=[],s=[],r=[];yd(t),vd(n,t);let o=t.length;e.forEach(yd);for(let l=0;l<e.length;l++)s.push(o),o+=e[l].length,vd(n,e[l]);let a=Bc.triangulate(n,s);for(let l=0;l<a.length;l+=3)r.push(a.slice(l,l+3));return r}};function yd(i){let t=i.length;t>2&&i[t-1].equals(i[0])&&i.pop()}function vd(i,t){for(let e=0;e<t.length;e++)i.push(t[e].x),i.push(t[e].y)}var gr=class i extends Ye{constructor(t=1,e=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:n,heightSegments:s};let r=t/2,o=e/2,a=Math.floor(n),l=Math.floor(s),c=a+1,h=l+1,u=t/a,d=e/l,f=[],m=[],x=[],p=[];for(let g=0;g<h;g++){let S=g*d-o;for(let w=0;w<c;w++){let b=w*u-r;m.push(b,-S,0),x.push(0,0,1),p.push(w/a),p.push(1-g/l)}}for(let g=0;g<l;g++)for(let S=0;S<a;S++){let w=S+c*g,b=S+c*(g+1),R=S+1+c*(g+1),A=S+1+c*g;f.push(w,b,A),f.push(b,R,A)}this.setIndex(f),this.setAttribute("position",new qe(m,3)),this.setAttribute("normal",new qe(x,3)),this.setAttribute("uv",new qe(p,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.width,t.height,t.widthSegments,t.heightSegments)}};function $i(i){let t={};for(let e in i){t[e]={};for(let n in i[e]){let s=i[e][n];if(Md(s))s.isRenderTargetTexture?(Lt("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][n]=null):t[e][n]=s.clone();else if(Array.isArray(s))if(Md(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();t[e][n]=r}else t[e][n]=s.slice();else t[e][n]=s}}return t}function Ge(i){let t={};for(let e=0;e<i.length;e++){let n=$i(i[e]);for(let s in n)t[s]=n[s]}return t}function Md(i){return i&&(i.isColor||i.isMatrix3||i.isMatrix4||i.isVector2||i.isVector3||i.isVector4||i.isTexture||i.isQuaternion)}function n0(i){let t=[];for(let e=0;e<i.length;e++)t.push(i[e].clone());return t}function yh(i){let t=i.getRenderTarget();return t===null?i.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:Kt.workingColorSpace}var yf={clone:$i,merge:Ge},i0=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,s0=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,zn=class extends Mi{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=i0,this.fragmentShader=s0,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=$i(t.uniforms),this.uniformsGroups=n0(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this.defaultAttributeValues=Object.assign({},t.defaultAttributeValues),this.index0AttributeName=t.index0AttributeName,this.uniformsNeedUpdate=t.uniformsNeedUpdate,this}toJSON(t){let e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?e.uniforms[s]={type:"t",value:o.toJSON(t).uuid}:o&&o.isColor?e.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?e.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?e.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?e.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?e.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?e.uniforms[s]={type:"m4",value:o.toArray()}:e.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;let n={};for(let s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(e.extensions=n),e}fromJSON(t,e){if(super.fromJSON(t,e),t.uniforms!==void 0)for(let n in t.uniforms){let s=t.uniforms[n];switch(this.uniforms[n]={},s.type){case"t":this.uniforms[n].value=e[s.value]||null;break;case"c":this.uniforms[n].value=new Ut().setHex(s.value);break;case"v2":this.uniforms[n].value=new It().fromArray(s.value);break;case"v3":this.uniforms[n].value=new N().fromArray(s.value);break;case"v4":this.uniforms[n].value=new ge().fromArray(s.value);break;case"m3":this.uniforms[n].value=new Ot().fromArray(s.value);break;case"m4":this.uniforms[n].value=new Qt().fromArray(s.value);break;default:this.uniforms[n].value=s.value}}if(t.defines!==void 0&&(this.defines=t.defines),t.vertexShader!==void 0&&(this.vertexShader=t.vertexShader),t.fragmentShader!==void 0&&(this.fragmentShader=t.fragmentShader),t.glslVersion!==void 0&&(this.glslVersion=t.glslVersion),t.extensions!==void 0)for(let n in t.extensions)this.extensions[n]=t.extensions[n];return t.lights!==void 0&&(this.lights=t.lights),t.clipping!==void 0&&(this.clipping=t.clipping),this}},Vn=class extends zn{constructor(t){super(t),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var qo=class extends Mi{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=jd,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}},$o=class extends Mi{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}};function cs(i,t){return!i||i.constructor===t?i:typeof t.BYTES_PER_ELEMENT=="number"?new t(i):Array.prototype.slice.call(i)}function Eo(i){return i!==void 0&&i.inTangents!==void 0&&i.outTangents!==void 0}var wi=class{constructor(t,e,n,s){this.parameterPositions=t,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new e.constructor(n),this.sampleValues=e,this.valueSize=n,this.settings=null,this.DefaultSettings_={}}evaluate(t){let e=this.parameterPositions,n=this._cachedIndex,s=e[n],r=e[n-1];n:{t:{let o;e:{i:if(!(t<s)){for(let a=n+2;;){if(s===void 0){if(t<r)break i;return n=e.length,this._cachedIndex=n,this.copySampleValue_(n-1)}if(n===a)break;if(r=s,s=e[++n],t<s)break t}o=e.length;break e}if(!(t>=r)){let a=e[1];t<a&&(n=2,r=a);for(let l=n-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===l)break;if(s=r,r=e[--n-1],t>=r)break t}o=n,n=0;break e}break n}for(;n<o;){let a=n+o>>>1;t<e[a]?o=a:n=a+1}if(s=e[n],r=e[n-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return n=e.length,this._cachedIndex=n,this.copySampleValue_(n-1)}this._cachedIndex=n,this.intervalChanged_(n,r,s)}return this.interpolate_(n,r,t,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(t){let e=this.resultBuffer,n=this.sampleValues,s=this.valueSize,r=t*s;for(let o=0;o!==s;++o)e[o]=n[r+o];return e}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},Yo=class extends wi{constructor(t,e,n,s){super(t,e,n,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:Lc,endingEnd:Lc}}intervalChanged_(t,e,n){let s=this.parameterPositions,r=t-2,o=t+1,a=s[r],l=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case Dc:r=t,a=2*e-n;break;case Nc:r=s.length-2,a=e+s[r]-s[r+1];break;default:r=t,a=n}if(l===void 0)switch(this.getSettings_().endingEnd){case Dc:o=t,l=2*n-e;break;case Nc:o=1,l=n+s[1]-s[0];break;default:o=t-1,l=e}let c=(n-e)*.5,h=this.valueSize;this._weightPrev=c/(e-a),this._weightNext=c/(l-n),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=this._offsetPrev,u=this._offsetNext,d=this._weightPrev,f=this._weightNext,m=(n-e)/(s-e),x=m*m,p=x*m,g=-d*p+2*d*x-d*m,S=(1+d)*p+(-1.5-2*d)*x+(-.5+d)*m+1,w=(-1-f)*p+(1.5+f)*x+.5*m,b=f*p-f*x;for(let R=0;R!==a;++R)r[R]=g*o[h+R]+S*o[c+R]+w*o[l+R]+b*o[u+R];return r}},Zo=class extends wi{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=(n-e)/(s-e),u=1-h;for(let d=0;d!==a;++d)r[d]=o[c+d]*u+o[l+d]*h;return r}},Jo=class extends wi{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t){return this.copySampleValue_(t-1)}},Ko=class extends wi{interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let m=(n-e)/(s-e),x=1-m;for(let p=0;p!==a;++p)r[p]=o[c+p]*x+o[l+p]*m;return r}let d=a*2,f=t-1;for(let m=0;m!==a;++m){let x=o[c+m],p=o[l+m],g=f*d+m*2,S=u[g],w=u[g+1],b=t*d+m*2,R=h[b],A=h[b+1],_=o0(n,e,S,R,s);r[m]=vf(_,x,w,A,p)}return r}};function vf(i,t,e,n,s){let r=1-i;return r*r*r*t+3*r*r*i*e+3*r*i*i*n+i*i*i*s}function r0(i,t,e,n,s){let r=1-i;return 3*r*r*(e-t)+6*r*i*(n-e)+3*i*i*(s-n)}function o0(i,t,e,n,s){let r=(i-t)/(s-t);for(let o=0;o<8;o++){let a=vf(r,t,e,n,s)-i;if(Math.abs(a)<1e-10)break;let l=r0(r,t,e,n,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var dn=class{constructor(t,e,n,s){if(t===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(e===void 0||e.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+t);this.name=t,this.times=cs(e,this.TimeBufferType),this.values=cs(n,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(t){let e=t.constructor,n;if(e.toJSON!==this.toJSON)n=e.toJSON(t);else{n={name:t.name,times:cs(t.times,Array),values:cs(t.values,Array)};let s=t.getInterpolation();s!==t.DefaultInterpolation&&(n.interpolation=s),Eo(t.settings)&&(n.settings={inTangents:cs(t.settings.inTangents,Array),outTangents:cs(t.settings.outTangents,Array)})}return n.type=t.ValueTypeName,n}InterpolantFactoryMethodDiscrete(t){return new Jo(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodLinear(t){return new Zo(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodSmooth(t){return new Yo(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodBezier(t){let e=new Ko(this.times,this.values,this.getValueSize(),t);return this.settings&&(e.inTangents=this.settings.inTangents,e.outTangents=this.settings.outTangents),e}setInterpolation(t){let e;switch(t){case Qs:e=this.InterpolantFactoryMethodDiscrete;break;case ko:e=this.InterpolantFactoryMethodLinear;break;case Ro:e=this.InterpolantFactoryMethodSmooth;break;case Ic:e=this.InterpolantFactoryMethodBezier;break}if(e===void 0){let n="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(t!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(n);return Lt("KeyframeTrack:",n),this}return this.createInterpolant=e,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return Qs;case this.InterpolantFactoryMethodLinear:return ko;case this.InterpolantFactoryMethodSmooth:return Ro;case this.InterpolantFactoryMethodBezier:return Ic}}getValueSize(){return this.values.length/this.times.length}shift(t){if(t!==0){let e=this.times;for(let n=0,s=e.length;n!==s;++n)e[n]+=t;Eo(this.settings)&&(bd(this.settings.inTangents,t),bd(this.settings.outTangents,t))}return this}scale(t){if(t!==1){let e=this.times;for(let n=0,s=e.length;n!==s;++n)e[n]*=t;Eo(this.settings)&&(Sd(this.settings.inTangents,t),Sd(this.settings.outTangents,t))}return this}trim(t,e){let n=this.times,s=n.length,r=0,o=s-1;for(;r!==s&&n[r]<t;)++r;for(;o!==-1&&n[o]>e;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=n.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let t=!0,e=this.getValueSize();e-Math.floor(e)!==0&&(Nt("KeyframeTrack: Invalid value size in track.",this),t=!1);let n=this.times,s=this.values,r=n.length;r===0&&(Nt("KeyframeTrack: Track is empty.",this),t=!1);let o=null;for(let a=0;a!==r;a++){let l=n[a];if(typeof l=="number"&&isNaN(l)){Nt("KeyframeTrack: Time is not a valid number.",this,a,l),t=!1;break}if(o!==null&&o>l){Nt("KeyframeTrack: Out of order keys.",this,a,l,o),t=!1;break}o=l}if(s!==void 0&&rg(s))for(let a=0,l=s.length;a!==l;++a){let c=s[a];if(isNaN(c)){Nt("KeyframeTrack: Value is not a valid number.",this,a,c),t=!1;break}}return t}optimize(){let t=this.times.slice(),e=this.values.slice(),n=this.getValueSize(),s=this.getInterpolation()===Ro,r=t.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=t[a],h=t[a+1];if(c!==h&&(a!==1||c!==t[0]))if(s)l=!0;else{let u=a*n,d=u-n,f=u+n;for(let m=0;m!==n;++m){let x=e[u+m];if(x!==e[d+m]||x!==e[f+m]){l=!0;break}}}if(l){if(a!==o){t[o]=t[a];let u=a*n,d=o*n;for(let f=0;f!==n;++f)e[d+f]=e[u+f]}++o}}if(r>0){t[o]=t[r];for(let a=r*n,l=o*n,c=0;c!==n;++c)e[l+c]=e[a+c];++o}return o!==t.length?(this.times=t.slice(0,o),this.values=e.slice(0,o*n)):(this.times=t,this.values=e),this}clone(){let t=this.times.slice(),e=this.values.slice(),n=this.constructor,s=new n(this.name,t,e);return s.createInterpolant=this.createInterpolant,Eo(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function bd(i,t){for(let e=0,n=i.length;e!==n;e+=2)i[e]+=t}function Sd(i,t){for(let e=0,n=i.length;e!==n;e+=2)i[e]*=t}dn.prototype.ValueTypeName="";dn.prototype.TimeBufferType=Float32Array;dn.prototype.ValueBufferType=Float32Array;dn.prototype.DefaultInterpolation=ko;var Ei=class extends dn{constructor(t,e,n){super(t,e,n)}};Ei.prototype.ValueTypeName="bool";Ei.prototype.ValueBufferType=Array;Ei.prototype.DefaultInterpolation=Qs;Ei.prototype.InterpolantFactoryMethodLinear=void 0;Ei.prototype.InterpolantFactoryMethodSmooth=void 0;var jo=class extends dn{constructor(t,e,n,s){super(t,e,n,s)}};jo.prototype.ValueTypeName="color";var Qo=class extends dn{constructor(t,e,n,s){super(t,e,n,s)}};Qo.prototype.ValueTypeName="number";var ta=class extends wi{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(n-e)/(s-e),c=t*a;for(let h=c+a;c!==h;c+=4)ln.slerpFlat(r,0,o,c-a,o,c,l);return r}},_r=class extends dn{constructor(t,e,n,s){super(t,e,n,s)}InterpolantFactoryMethodLinear(t){return new ta(this.times,this.values,this.getValueSize(),t)}};_r.prototype.ValueTypeName="quaternion";_r.prototype.InterpolantFactoryMethodSmooth=void 0;var Ti=class extends dn{constructor(t,e,n){super(t,e,n)}};Ti.prototype.ValueTypeName="string";Ti.prototype.ValueBufferType=Array;Ti.prototype.DefaultInterpolation=Qs;Ti.prototype.InterpolantFactoryMethodLinear=void 0;Ti.prototype.InterpolantFactoryMethodSmooth=void 0;var ea=class extends dn{constructor(t,e,n,s){super(t,e,n,s)}};ea.prototype.ValueTypeName="vector";var na=class{constructor(t,e,n){let s=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=t,this.onProgress=e,this.onError=n,this._abortController=null,this.itemStart=function(h){a++,r===!1&&s.onStart!==void 0&&s.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,s.onProgress!==void 0&&s.onProgress(h,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,d=c.length;u<d;u+=2){let f=c[u],m=c[u+1];if(f.global&&(f.lastIndex=0),f.test(h))return m}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},Mf=new na,ia=class{constructor(t){this.manager=t!==void 0?t:Mf,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(t,e){let n=this;return new Promise(function(s,r){n.load(t,s,e,r)})}parse(){}setCrossOrigin(t){return this.crossOrigin=t,this}setWithCredentials(t){return this.withCredentials=t,this}setPath(t){return this.path=t,this}setResourcePath(t){return this.resourcePath=t,this}setRequestHeader(t){return this.requestHeader=t,this}setPriority(t){return this.priority=t,this}setCache(t){return this.cache=t,this}abort(){return this}};ia.DEFAULT_MATERIAL_NAME="__DEFAULT";var To=new N,Ao=new ln,Un=new N,xr=class extends hn{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new Qt,this.projectionMatrix=new Qt,this.projectionMatrixInverse=new Qt,this.coordinateSystem=Mn,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorld.decompose(To,Ao,Un),Un.x===1&&Un.y===1&&Un.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(To,Ao,Un.set(1,1,1)).invert()}updateWorldMatrix(t,e,n=!1){super.updateWorldMatrix(t,e,n),this.matrixWorld.decompose(To,Ao,Un),Un.x===1&&Un.y===1&&Un.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(To,Ao,Un.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},xi=new N,wd=new It,Ed=new It,Xe=class extends xr{constructor(t=50,e=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){let e=.5*this.getFilmHeight()/t;this.fov=ms*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){let t=Math.tan(Ks*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return ms*2*Math.atan(Math.tan(Ks*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,n){xi.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(xi.x,xi.y).multiplyScalar(-t/xi.z),xi.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(xi.x,xi.y).multiplyScalar(-t/xi.z)}getViewSize(t,e){return this.getViewBounds(t,wd,Ed),e.subVectors(Ed,wd)}setViewOffset(t,e,n,s,r,o){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=this.near,e=t*Math.tan(Ks*.5*this.fov)/this.zoom,n=2*e,s=this.aspect*n,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,e-=o.offsetY*n/c,s*=o.width/l,n*=o.height/c}let a=this.filmOffset;a!==0&&(r+=t*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,e,e-n,t,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}};var sa=class extends xr{constructor(t=-1,e=1,n=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=n,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,n,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=n-t,o=n+t,a=s+e,l=s-e;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}};var hs=-90,us=1,Ms=class extends hn{constructor(t,e,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new Xe(hs,us,t,e);s.layers=this.layers,this.add(s);let r=new Xe(hs,us,t,e);r.layers=this.layers,this.add(r);let o=new Xe(hs,us,t,e);o.layers=this.layers,this.add(o);let a=new Xe(hs,us,t,e);a.layers=this.layers,this.add(a);let l=new Xe(hs,us,t,e);l.layers=this.layers,this.add(l);let c=new Xe(hs,us,t,e);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let t=this.coordinateSystem,e=this.children.concat(),[n,s,r,o,a,l]=e;for(let c of e)this.remove(c);if(t===Mn)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(t===nr)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(let c of e)this.add(c),c.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();let{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,h]=this.children,u=t.getRenderTarget(),d=t.getActiveCubeFace(),f=t.getActiveMipmapLevel(),m=t.xr.enabled;t.xr.enabled=!1;let x=n.texture.mipmapsAutoUpdate;n.texture.mipmapsAutoUpdate=!1;let p=!1;t.isWebGLRenderer===!0?p=t.state.buffers.depth.getReversed():p=t.reversedDepthBuffer,t.setRenderTarget(n,0,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,r),t.setRenderTarget(n,1,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,o),t.setRenderTarget(n,2,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,a),t.setRenderTarget(n,3,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,l),t.setRenderTarget(n,4,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,c),n.texture.mipmapsAutoUpdate=x,t.setRenderTarget(n,5,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,h),t.setRenderTarget(u,d,f),t.xr.enabled=m,n.texture.needsPMREMUpdate=!0}},ra=class extends Xe{constructor(t=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=t,this.perCameraFrustumCulled=!1}};var vh="\\[\\]\\.:\\/",a0=new RegExp("["+vh+"]","g"),Mh="[^"+vh+"]",l0="[^"+vh.replace("\\.","")+"]",c0=/((?:WC+[\/:])*)/.source.replace("WC",Mh),h0=/(WCOD+)?/.source.replace("WCOD",l0),u0=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",Mh),d0=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",Mh),f0=new RegExp("^"+c0+h0+u0+d0+"$"),p0=["material","materials","bones","map"],kc=class{constructor(t,e,n){let s=n||ce.parseTrackName(e);this._targetGroup=t,this._bindings=t.subscribe_(e,s)}getValue(t,e){this.bind();let n=this._targetGroup.nCachedObjects_,s=this._bindings[n];s!==void 0&&s.getValue(t,e)}setValue(t,e){let n=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=n.length;s!==r;++s)n[s].setValue(t,e)}bind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,n=t.length;e!==n;++e)t[e].bind()}unbind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,n=t.length;e!==n;++e)t[e].unbind()}},ce=class i{constructor(t,e,n){this.path=e,this.parsedPath=n||i.parseTrackName(e),this.node=i.findNode(t,this.parsedPath.nodeName),this.rootNode=t,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(t,e,n){return t&&t.isAnimationObjectGroup?new i.Composite(t,e,n):new i(t,e,n)}static sanitizeNodeName(t){return t.replace(/\s/g,"_").replace(a0,"")}static parseTrackName(t){let e=f0.exec(t);if(e===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+t);let n={nodeName:e[2],objectName:e[3],objectIndex:e[4],propertyName:e[5],propertyIndex:e[6]},s=n.nodeName&&n.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=n.nodeName.substring(s+1);p0.indexOf(r)!==-1&&(n.nodeName=n.nodeName.substring(0,s),n.objectName=r)}if(n.propertyName===null||n.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+t);return n}static findNode(t,e){if(e===void 0||e===""||e==="."||e===-1||e===t.name||e===t.uuid)return t;if(t.skeleton){let n=t.skeleton.getBoneByName(e);if(n!==void 0)return n}if(t.children){let n=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===e||a.uuid===e)return a;let l=n(a.children);if(l)return l}return null},s=n(t.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(t,e){t[e]=this.targetObject[this.propertyName]}_getValue_array(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)t[e++]=n[s]}_getValue_arrayElement(t,e){t[e]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(t,e){this.resolvedProperty.toArray(t,e)}_setValue_direct(t,e){this.targetObject[this.propertyName]=t[e]}_setValue_direct_setNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++]}_setValue_array_setNeedsUpdate(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(t,e){this.resolvedProperty[this.propertyIndex]=t[e]}_setValue_arrayElement_setNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(t,e){this.resolvedProperty.fromArray(t,e)}_setValue_fromArray_setNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(t,e){this.bind(),this.getValue(t,e)}_setValue_unbound(t,e){this.bind(),this.setValue(t,e)}bind(){let t=this.node,e=this.parsedPath,n=e.objectName,s=e.propertyName,r=e.propertyIndex;if(t||(t=i.findNode(this.rootNode,e.nodeName),this.node=t),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!t){Lt("PropertyBinding: No target node found for track: "+this.path+".");return}if(n){let c=e.objectIndex;switch(n){case"materials":if(!t.material){Nt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.materials){Nt("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}t=t.material.materials;break;case"bones":if(!t.skeleton){Nt("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}t=t.skeleton.bones;for(let h=0;h<t.length;h++)if(t[h].name===c){c=h;break}break;case"map":if("map"in t){t=t.map;break}if(!t.material){Nt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.map){Nt("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}t=t.material.map;break;default:if(t[n]===void 0){Nt("PropertyBinding: Can not bind to objectName of node undefined.",this);return}t=t[n]}if(c!==void 0){if(t[c]===void 0){Nt("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,t);return}t=t[c]}}let o=t[s];if(o===void 0){let c=e.nodeName;Nt("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",t);return}let a=this.Versioning.None;this.targetObject=t,t.isMaterial===!0?a=this.Versioning.NeedsUpdate:t.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!t.geometry){Nt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!t.geometry.morphAttributes){Nt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}t.morphTargetDictionary[r]!==void 0&&(r=t.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};ce.Composite=kc;ce.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};ce.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};ce.prototype.GetterByBindingType=[ce.prototype._getValue_direct,ce.prototype._getValue_array,ce.prototype._getValue_arrayElement,ce.prototype._getValue_toArray];ce.prototype.SetterByBindingTypeAndVersioning=[[ce.prototype._setValue_direct,ce.prototype._setValue_direct_setNeedsUpdate,ce.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[ce.prototype._setValue_array,ce.prototype._setValue_array_setNeedsUpdate,ce.prototype._setValue_array_setMatrixWorldNeedsUpdate],[ce.prototype._setValue_arrayElement,ce.prototype._setValue_arrayElement_setNeedsUpdate,ce.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[ce.prototype._setValue_fromArray,ce.prototype._setValue_fromArray_setNeedsUpdate,ce.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var n1=new Float32Array(1);var Td=new Qt,yr=class{constructor(t,e,n=0,s=1/0){this.ray=new kn(t,e),this.near=n,this.far=s,this.camera=null,this.layers=new _s,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(t,e){this.ray.set(t,e)}setFromCamera(t,e){e.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(t.x,t.y,.5).unproject(e).sub(this.ray.origin).normalize(),this.camera=e):e.isOrthographicCamera?(this.ray.origin.set(t.x,t.y,e.projectionMatrix.elements[14]).unproject(e),this.ray.direction.set(0,0,-1).transformDirection(e.matrixWorld),this.camera=e):Nt("Raycaster: Unsupported camera type: "+e.type)}setFromXRController(t){return Td.identity().extractRotation(t.matrixWorld),this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(Td),this}intersectObject(t,e=!0,n=[]){return zc(t,this,n,e),n.sort(Ad),n}intersectObjects(t,e=!0,n=[]){for(let s=0,r=t.length;s<r;s++)zc(t[s],this,n,e);return n.sort(Ad),n}};function Ad(i,t){return i.distance-t.distance}function zc(i,t,e,n){let s=!0;if(i.layers.test(t.layers)&&i.raycast(t,e)===!1&&(s=!1),s===!0&&n===!0){let r=i.children;for(let o=0,a=r.length;o<a;o++)zc(r[o],t,e,!0)}}var bs=class{constructor(t=1,e=0,n=0){this.radius=t,this.phi=e,this.theta=n}set(t,e,n){return this.radius=t,this.phi=e,this.theta=n,this}copy(t){return this.radius=t.radius,this.phi=t.phi,this.theta=t.theta,this}makeSafe(){return this.phi=qt(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(t){return this.setFromCartesianCoords(t.x,t.y,t.z)}setFromCartesianCoords(t,e,n){return this.radius=Math.sqrt(t*t+e*e+n*n),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(t,n),this.phi=Math.acos(qt(e/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var Vc=class{static{this.prototype.isMatrix2=!0}constructor(t,e,n,s){this.elements=[1,0,0,1],t!==void 0&&this.set(t,e,n,s)}identity(){return this.set(1,0,0,1),this}fromArray(t,e=0){for(let n=0;n<4;n++)this.elements[n]=t[n+e];return this}set(t,e,n,s){let r=this.elements;return r[0]=t,r[2]=e,r[1]=n,r[3]=s,this}};var vr=class extends An{constructor(t,e=null){super(),this.object=t,this.domElement=e,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(t){this.domElement!==null&&this.disconnect(),this.domElement=t}disconnect(){}dispose(){}update(){}};function bh(i,t,e,n){let s=m0(n);switch(e){case ah:return i*t;case ch:return i*t/s.components*s.byteLength;case da:return i*t/s.components*s.byteLength;case Ci:return i*t*2/s.components*s.byteLength;case fa:return i*t*2/s.components*s.byteLength;case lh:return i*t*3/s.components*s.byteLength;case Ke:return i*t*4/s.components*s.byteLength;case pa:return i*t*4/s.components*s.byteLength;case Sr:case wr:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case Er:case Tr:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case ga:case xa:return Math.max(i,16)*Math.max(t,8)/4;case ma:case _a:return Math.max(i,8)*Math.max(t,8)/2;case ya:case va:case ba:case Sa:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case Ma:case Ar:case wa:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Ea:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Ta:return Math.floor((i+4)/5)*Math.floor((t+3)/4)*16;case Aa:return Math.floor((i+4)/5)*Math.floor((t+4)/5)*16;case Ra:return Math.floor((i+5)/6)*Math.floor((t+4)/5)*16;case Ca:return Math.floor((i+5)/6)*Math.floor((t+5)/6)*16;case Pa:return Math.floor((i+7)/8)*Math.floor((t+4)/5)*16;case Ia:return Math.floor((i+7)/8)*Math.floor((t+5)/6)*16;case La:return Math.floor((i+7)/8)*Math.floor((t+7)/8)*16;case Da:return Math.floor((i+9)/10)*Math.floor((t+4)/5)*16;case Na:return Math.floor((i+9)/10)*Math.floor((t+5)/6)*16;case Oa:return Math.floor((i+9)/10)*Math.floor((t+7)/8)*16;case Ua:return Math.floor((i+9)/10)*Math.floor((t+9)/10)*16;case Fa:return Math.floor((i+11)/12)*Math.floor((t+9)/10)*16;case Ba:return Math.floor((i+11)/12)*Math.floor((t+11)/12)*16;case ka:case za:case Va:return Math.ceil(i/4)*Math.ceil(t/4)*16;case Ga:case Ha:return Math.ceil(i/4)*Math.ceil(t/4)*8;case Rr:case Wa:return Math.ceil(i/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function m0(i){switch(i){case Je:case ih:return{byteLength:1,components:1};case Ts:case sh:case Pn:return{byteLength:2,components:1};case ha:case ua:return{byteLength:2,components:4};case Cn:case ca:case pn:return{byteLength:4,components:1};case rh:case oh:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${i}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Lt("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function Hf(){let i=null,t=!1,e=null,n=null;function s(r,o){n=i.requestAnimationFrame(s),e(r,o)}return{start:function(){t!==!0&&e!==null&&i!==null&&(n=i.requestAnimationFrame(s),t=!0)},stop:function(){i!==null&&i.cancelAnimationFrame(n),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){i=r}}}function _0(i){let t=new WeakMap;function e(a,l){let c=a.array,h=a.usage,u=c.byteLength,d=i.createBuffer();i.bindBuffer(l,d),i.bufferData(l,c,h),a.onUploadCallback();let f;if(c instanceof Float32Array)f=i.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)f=i.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?f=i.HALF_FLOAT:f=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)f=i.SHORT;else if(c instanceof Uint32Array)f=i.UNSIGNED_INT;else if(c instanceof Int32Array)f=i.INT;else if(c instanceof Int8Array)f=i.BYTE;else if(c instanceof Uint8Array)f=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)f=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:d,type:f,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function n(a,l,c){let h=l.array,u=l.updateRanges;if(i.bindBuffer(c,a),u.length===0)i.bufferSubData(c,0,h);else{u.sort((f,m)=>f.start-m.start);let d=0;for(let f=1;f<u.length;f++){let m=u[d],x=u[f];x.start<=m.start+m.count+1?m.count=Math.max(m.count,x.start+x.count-m.start):(++d,u[d]=x)}u.length=d+1;for(let f=0,m=u.length;f<m;f++){let x=u[f];i.bufferSubData(c,x.start*h.BYTES_PER_ELEMENT,h,x.start,x.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),t.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=t.get(a);l&&(i.deleteBuffer(l.buffer),t.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=t.get(a);(!h||h.version<a.version)&&t.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=t.get(a);if(c===void 0)t.set(a,e(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}var x0=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,y0=`#ifdef USE_ALPHAHASH
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
#endif`,v0=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,M0=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,b0=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,S0=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,w0=`#ifdef USE_AOMAP
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
#endif`,E0=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,T0=`#ifdef USE_BATCHING
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
#endif`,A0=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,R0=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,C0=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,P0=`float G_BlinnPhong_Implicit( ) {
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
} // validated`,I0=`#ifdef USE_IRIDESCENCE
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
#endif`,L0=`#ifdef USE_BUMPMAP
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
#endif`,D0=`#if NUM_CLIPPING_PLANES > 0
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
#endif`,N0=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,O0=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,U0=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,F0=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,B0=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,k0=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,z0=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
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
#endif`,V0=`#define PI 3.141592653589793
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
} // validated`,G0=`vec3 transformedNormal = objectNormal;
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
#endif`,H0=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,W0=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,X0=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,q0=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,$0="gl_FragColor = linearToOutputTexel( gl_FragColor );",Y0=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,Z0=`#ifdef USE_ENVMAP
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
#endif`,J0=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,K0=`#ifdef USE_ENVMAP
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
#endif`,j0=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,Q0=`#ifdef USE_ENVMAP
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
#endif`,t_=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,e_=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,n_=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,i_=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,s_=`#ifdef USE_GRADIENTMAP
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
}`,r_=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,o_=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,a_=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,l_=`uniform bool receiveShadow;
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
#include <lightprobes_pars_fragment>`,c_=`#ifdef USE_ENVMAP
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
#endif`,h_=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,u_=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,d_=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,f_=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,p_=`PhysicalMaterial material;
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
#endif`,m_=`uniform sampler2D dfgLUT;
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
}`,g_=`
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
#endif`,__=`#if defined( RE_IndirectDiffuse )
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
#endif`,x_=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,y_=`#if NUM_LIGHT_PROBE_GRIDS > 0
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
#endif`,v_=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,M_=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,b_=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,S_=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,w_=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,E_=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,T_=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
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
#endif`,A_=`#if defined( USE_POINTS_UV )
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
#endif`,R_=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,C_=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,P_=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,I_=`#if defined( USE_MORPHCOLORS )
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
#endif`,L_=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,D_=`#ifdef USE_MORPHTARGETS
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
#endif`,N_=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,O_=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
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
vec3 nonPerturbedNormal = normal;`,U_=`#ifdef USE_NORMALMAP_OBJECTSPACE
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
#endif`,F_=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,B_=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,k_=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,z_=`#ifdef USE_NORMALMAP
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
#endif`,V_=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,G_=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,H_=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,W_=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,X_=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,q_=`vec3 packNormalToRGB( const in vec3 normal ) {
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
}`,$_=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,Y_=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,Z_=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,J_=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,K_=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,j_=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,Q_=`#if NUM_SPOT_LIGHT_COORDS > 0
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
#endif`,tx=`#if NUM_SPOT_LIGHT_COORDS > 0
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
#endif`,ex=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
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
#endif`,nx=`float getShadowMask() {
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
}`,ix=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,sx=`#ifdef USE_SKINNING
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
#endif`,rx=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,ox=`#ifdef USE_SKINNING
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
#endif`,ax=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,lx=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,cx=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,hx=`#ifndef saturate
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
vec3 CustomToneMapping( vec3 color ) { return color; }`,ux=`#ifdef USE_TRANSMISSION
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
#endif`,dx=`#ifdef USE_TRANSMISSION
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
#endif`,fx=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,px=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,mx=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,gx=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,_x=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,xx=`uniform sampler2D t2D;
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
}`,yx=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,vx=`uniform float backgroundBlurriness;
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
}`,Mx=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,bx=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Sx=`#include <common>
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
}`,wx=`#if DEPTH_PACKING == 3200
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
}`,Ex=`#define DISTANCE
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
}`,Tx=`#define DISTANCE
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
}`,Ax=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,Rx=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Cx=`uniform float scale;
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
}`,Px=`uniform vec3 diffuse;
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
}`,Ix=`#include <common>
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
}`,Lx=`uniform vec3 diffuse;
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
}`,Dx=`#define LAMBERT
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
}`,Nx=`#define LAMBERT
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
}`,Ox=`#define MATCAP
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
}`,Ux=`#define MATCAP
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
}`,Fx=`#define NORMAL
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
}`,Bx=`#define NORMAL
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
}`,kx=`#define PHONG
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
}`,zx=`#define PHONG
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
}`,Vx=`#define STANDARD
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
}`,Gx=`#define STANDARD
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
}`,Hx=`#define TOON
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
}`,Wx=`#define TOON
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
}`,Xx=`uniform float size;
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
}`,qx=`uniform vec3 diffuse;
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
}`,$x=`#include <common>
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
}`,Yx=`uniform vec3 color;
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
}`,Zx=`uniform float rotation;
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
}`,Jx=`uniform vec3 diffuse;
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
}`,Xt={alphahash_fragment:x0,alphahash_pars_fragment:y0,alphamap_fragment:v0,alphamap_pars_fragment:M0,alphatest_fragment:b0,alphatest_pars_fragment:S0,aomap_fragment:w0,aomap_pars_fragment:E0,batching_pars_vertex:T0,batching_vertex:A0,begin_vertex:R0,beginnormal_vertex:C0,bsdfs:P0,iridescence_fragment:I0,bumpmap_pars_fragment:L0,clipping_planes_fragment:D0,clipping_planes_pars_fragment:N0,clipping_planes_pars_vertex:O0,clipping_planes_vertex:U0,color_fragment:F0,color_pars_fragment:B0,color_pars_vertex:k0,color_vertex:z0,common:V0,defaultnormal_vertex:G0,displacementmap_pars_vertex:H0,displacementmap_vertex:W0,emissivemap_fragment:X0,emissivemap_pars_fragment:q0,colorspace_fragment:$0,colorspace_pars_fragment:Y0,envmap_fragment:Z0,envmap_common_pars_fragment:J0,envmap_pars_fragment:K0,envmap_pars_vertex:j0,envmap_physical_pars_fragment:c_,envmap_vertex:Q0,fog_vertex:t_,fog_pars_vertex:e_,fog_fragment:n_,fog_pars_fragment:i_,gradientmap_pars_fragment:s_,lightmap_pars_fragment:r_,lights_lambert_fragment:o_,lights_lambert_pars_fragment:a_,lights_pars_begin:l_,lights_toon_fragment:h_,lights_toon_pars_fragment:u_,lights_phong_fragment:d_,lights_phong_pars_fragment:f_,lights_physical_fragment:p_,lights_physical_pars_fragment:m_,lights_fragment_begin:g_,lights_fragment_maps:__,lights_fragment_end:x_,lightprobes_pars_fragment:y_,logdepthbuf_fragment:v_,logdepthbuf_pars_fragment:M_,logdepthbuf_pars_vertex:b_,logdepthbuf_vertex:S_,map_fragment:w_,map_pars_fragment:E_,map_particle_fragment:T_,map_particle_pars_fragment:A_,metalnessmap_fragment:R_,metalnessmap_pars_fragment:C_,morphinstance_vertex:P_,morphcolor_vertex:I_,morphnormal_vertex:L_,morphtarget_pars_vertex:D_,morphtarget_vertex:N_,normal_fragment_begin:O_,normal_fragment_maps:U_,normal_pars_fragment:F_,normal_pars_vertex:B_,normal_vertex:k_,normalmap_pars_fragment:z_,clearcoat_normal_fragment_begin:V_,clearcoat_normal_fragment_maps:G_,clearcoat_pars_fragment:H_,iridescence_pars_fragment:W_,opaque_fragment:X_,packing:q_,premultiplied_alpha_fragment:$_,project_vertex:Y_,dithering_fragment:Z_,dithering_pars_fragment:J_,roughnessmap_fragment:K_,roughnessmap_pars_fragment:j_,shadowmap_pars_fragment:Q_,shadowmap_pars_vertex:tx,shadowmap_vertex:ex,shadowmask_pars_fragment:nx,skinbase_vertex:ix,skinning_pars_vertex:sx,skinning_vertex:rx,skinnormal_vertex:ox,specularmap_fragment:ax,specularmap_pars_fragment:lx,tonemapping_fragment:cx,tonemapping_pars_fragment:hx,transmission_fragment:ux,transmission_pars_fragment:dx,uv_pars_fragment:fx,uv_pars_vertex:px,uv_vertex:mx,worldpos_vertex:gx,background_vert:_x,background_frag:xx,backgroundCube_vert:yx,backgroundCube_frag:vx,cube_vert:Mx,cube_frag:bx,depth_vert:Sx,depth_frag:wx,distance_vert:Ex,distance_frag:Tx,equirect_vert:Ax,equirect_frag:Rx,linedashed_vert:Cx,linedashed_frag:Px,meshbasic_vert:Ix,meshbasic_frag:Lx,meshlambert_vert:Dx,meshlambert_frag:Nx,meshmatcap_vert:Ox,meshmatcap_frag:Ux,meshnormal_vert:Fx,meshnormal_frag:Bx,meshphong_vert:kx,meshphong_frag:zx,meshphysical_vert:Vx,meshphysical_frag:Gx,meshtoon_vert:Hx,meshtoon_frag:Wx,points_vert:Xx,points_frag:qx,shadow_vert:$x,shadow_frag:Yx,sprite_vert:Zx,sprite_frag:Jx},gt={common:{diffuse:{value:new Ut(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new Ot},alphaMap:{value:null},alphaMapTransform:{value:new Ot},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new Ot}},envmap:{envMap:{value:null},envMapRotation:{value:new Ot},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new Ot}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new Ot}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new Ot},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new Ot},normalScale:{value:new It(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new Ot},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new Ot}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new Ot}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new Ot}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new Ut(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new Ut(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new Ot},alphaTest:{value:0},uvTransform:{value:new Ot}},sprite:{diffuse:{value:new Ut(16777215)},opacity:{value:1},center:{value:new It(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new Ot},alphaMap:{value:null},alphaMapTransform:{value:new Ot},alphaTest:{value:0}}},Xn={basic:{uniforms:Ge([gt.common,gt.specularmap,gt.envmap,gt.aomap,gt.lightmap,gt.fog]),vertexShader:Xt.meshbasic_vert,fragmentShader:Xt.meshbasic_frag},lambert:{uniforms:Ge([gt.common,gt.specularmap,gt.envmap,gt.aomap,gt.lightmap,gt.emissivemap,gt.bumpmap,gt.normalmap,gt.displacementmap,gt.fog,gt.lights,{emissive:{value:new Ut(0)},envMapIntensity:{value:1}}]),vertexShader:Xt.meshlambert_vert,fragmentShader:Xt.meshlambert_frag},phong:{uniforms:Ge([gt.common,gt.specularmap,gt.envmap,gt.aomap,gt.lightmap,gt.emissivemap,gt.bumpmap,gt.normalmap,gt.displacementmap,gt.fog,gt.lights,{emissive:{value:new Ut(0)},specular:{value:new Ut(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:Xt.meshphong_vert,fragmentShader:Xt.meshphong_frag},standard:{uniforms:Ge([gt.common,gt.envmap,gt.aomap,gt.lightmap,gt.emissivemap,gt.bumpmap,gt.normalmap,gt.displacementmap,gt.roughnessmap,gt.metalnessmap,gt.fog,gt.lights,{emissive:{value:new Ut(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:Xt.meshphysical_vert,fragmentShader:Xt.meshphysical_frag},toon:{uniforms:Ge([gt.common,gt.aomap,gt.lightmap,gt.emissivemap,gt.bumpmap,gt.normalmap,gt.displacementmap,gt.gradientmap,gt.fog,gt.lights,{emissive:{value:new Ut(0)}}]),vertexShader:Xt.meshtoon_vert,fragmentShader:Xt.meshtoon_frag},matcap:{uniforms:Ge([gt.common,gt.bumpmap,gt.normalmap,gt.displacementmap,gt.fog,{matcap:{value:null}}]),vertexShader:Xt.meshmatcap_vert,fragmentShader:Xt.meshmatcap_frag},points:{uniforms:Ge([gt.points,gt.fog]),vertexShader:Xt.points_vert,fragmentShader:Xt.points_frag},dashed:{uniforms:Ge([gt.common,gt.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:Xt.linedashed_vert,fragmentShader:Xt.linedashed_frag},depth:{uniforms:Ge([gt.common,gt.displacementmap]),vertexShader:Xt.depth_vert,fragmentShader:Xt.depth_frag},normal:{uniforms:Ge([gt.common,gt.bumpmap,gt.normalmap,gt.displacementmap,{opacity:{value:1}}]),vertexShader:Xt.meshnormal_vert,fragmentShader:Xt.meshnormal_frag},sprite:{uniforms:Ge([gt.sprite,gt.fog]),vertexShader:Xt.sprite_vert,fragmentShader:Xt.sprite_frag},background:{uniforms:{uvTransform:{value:new Ot},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:Xt.background_vert,fragmentShader:Xt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new Ot}},vertexShader:Xt.backgroundCube_vert,fragmentShader:Xt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:Xt.cube_vert,fragmentShader:Xt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:Xt.equirect_vert,fragmentShader:Xt.equirect_frag},distance:{uniforms:Ge([gt.common,gt.displacementmap,{referencePosition:{value:new N},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:Xt.distance_vert,fragmentShader:Xt.distance_frag},shadow:{uniforms:Ge([gt.lights,gt.fog,{color:{value:new Ut(0)},opacity:{value:1}}]),vertexShader:Xt.shadow_vert,fragmentShader:Xt.shadow_frag}};Xn.physical={uniforms:Ge([Xn.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new Ot},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new Ot},clearcoatNormalScale:{value:new It(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new Ot},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new Ot},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new Ot},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new Ot},sheen:{value:0},sheenColor:{value:new Ut(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new Ot},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new Ot},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new Ot},transmissionSamplerSize:{value:new It},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new Ot},attenuationDistance:{value:0},attenuationColor:{value:new Ut(0)},specularColor:{value:new Ut(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new Ot},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new Ot},anisotropyVector:{value:new It},anisotropyMap:{value:null},anisotropyMapTransform:{value:new Ot}}]),vertexShader:Xt.meshphysical_vert,fragmentShader:Xt.meshphysical_frag};var Xa={r:0,b:0,g:0},Kx=new Qt,Wf=new Ot;Wf.set(-1,0,0,0,1,0,0,0,1);function jx(i,t,e,n,s,r){let o=new Ut(0),a=s===!0?0:1,l,c,h=null,u=0,d=null;function f(S){let w=S.isScene===!0?S.background:null;if(w&&w.isTexture){let b=S.backgroundBlurriness>0;w=t.get(w,b)}return w}function m(S){let w=!1,b=f(S);b===null?p(o,a):b&&b.isColor&&(p(b,1),w=!0);let R=i.xr.getEnvironmentBlendMode();R==="additive"?e.buffers.color.setClear(0,0,0,1,r):R==="alpha-blend"&&e.buffers.color.setClear(0,0,0,0,r),(i.autoClear||w)&&(e.buffers.depth.setTest(!0),e.buffers.depth.setMask(!0),e.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function x(S,w){let b=f(w);b&&b.isCubeTexture?(c===void 0&&(c=new tn(new ys(1,1,1),new zn({name:"BackgroundCubeMaterial",uniforms:$i(Xn.backgroundCube.uniforms),vertexShader:Xn.backgroundCube.vertexShader,fragmentShader:Xn.backgroundCube.fragmentShader,side:Ze,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(R,A,_){this.matrixWorld.copyPosition(_.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),n.update(c)),c.material.uniforms.envMap.value=b,c.material.uniforms.backgroundBlurriness.value=w.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=w.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(Kx.makeRotationFromEuler(w.backgroundRotation)).transpose(),b.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(Wf),c.material.toneMapped=Kt.getTransfer(b.colorSpace)!==ie,(h!==b||u!==b.version||d!==i.toneMapping)&&(c.material.needsUpdate=!0,h=b,u=b.version,d=i.toneMapping),c.layers.enableAll(),S.unshift(c,c.geometry,c.material,0,0,null)):b&&b.isTexture&&(l===void 0&&(l=new tn(new gr(2,2),new zn({name:"BackgroundMaterial",uniforms:$i(Xn.background.uniforms),vertexShader:Xn.background.vertexShader,fragmentShader:Xn.background.fragmentShader,side:Gn,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),n.update(l)),l.material.uniforms.t2D.value=b,l.material.uniforms.backgroundIntensity.value=w.backgroundIntensity,l.material.toneMapped=Kt.getTransfer(b.colorSpace)!==ie,b.matrixAutoUpdate===!0&&b.updateMatrix(),l.material.uniforms.uvTransform.value.copy(b.matrix),(h!==b||u!==b.version||d!==i.toneMapping)&&(l.material.needsUpdate=!0,h=b,u=b.version,d=i.toneMapping),l.layers.enableAll(),S.unshift(l,l.geometry,l.material,0,0,null))}function p(S,w){S.getRGB(Xa,yh(i)),e.buffers.color.setClear(Xa.r,Xa.g,Xa.b,w,r)}function g(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(S,w=1){o.set(S),a=w,p(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(S){a=S,p(o,a)},render:m,addToRenderList:x,dispose:g}}function Qx(i,t){let e=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=d(null),r=s,o=!1;function a(O,V,Y,I,q){let j=!1,H=u(O,I,Y,V);r!==H&&(r=H,c(r.object)),j=f(O,I,Y,q),j&&m(O,I,Y,q),q!==null&&t.update(q,i.ELEMENT_ARRAY_BUFFER),(j||o)&&(o=!1,b(O,V,Y,I),q!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,t.get(q).buffer))}function l(){return i.createVertexArray()}function c(O){return i.bindVertexArray(O)}function h(O){return i.deleteVertexArray(O)}function u(O,V,Y,I){let q=I.wireframe===!0,j=n[V.id];j===void 0&&(j={},n[V.id]=j);let H=O.isInstancedMesh===!0?O.id:0,st=j[H];st===void 0&&(st={},j[H]=st);let X=st[Y.id];X===void 0&&(X={},st[Y.id]=X);let tt=X[q];return tt===void 0&&(tt=d(l()),X[q]=tt),tt}function d(O){let V=[],Y=[],I=[];for(let q=0;q<e;q++)V[q]=0,Y[q]=0,I[q]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:V,enabledAttributes:Y,attributeDivisors:I,object:O,attributes:{},index:null}}function f(O,V,Y,I){let q=r.attributes,j=V.attributes,H=0,st=Y.getAttributes();for(let X in st)if(st[X].location>=0){let et=q[X],wt=j[X];if(wt===void 0&&(X==="instanceMatrix"&&O.instanceMatrix&&(wt=O.instanceMatrix),X==="instanceColor"&&O.instanceColor&&(wt=O.instanceColor)),et===void 0||et.attribute!==wt||wt&&et.data!==wt.data)return!0;H++}return r.attributesNum!==H||r.index!==I}function m(O,V,Y,I){let q={},j=V.attributes,H=0,st=Y.getAttributes();for(let X in st)if(st[X].location>=0){let et=j[X];et===void 0&&(X==="instanceMatrix"&&O.instanceMatrix&&(et=O.instanceMatrix),X==="instanceColor"&&O.instanceColor&&(et=O.instanceColor));let wt={};wt.attribute=et,et&&et.data&&(wt.data=et.data),q[X]=wt,H++}r.attributes=q,r.attributesNum=H,r.index=I}function x(){let O=r.newAttributes;for(let V=0,Y=O.length;V<Y;V++)O[V]=0}function p(O){g(O,0)}function g(O,V){let Y=r.newAttributes,I=r.enabledAttributes,q=r.attributeDivisors;Y[O]=1,I[O]===0&&(i.enableVertexAttribArray(O),I[O]=1),q[O]!==V&&(i.vertexAttribDivisor(O,V),q[O]=V)}function S(){let O=r.newAttributes,V=r.enabledAttributes;for(let Y=0,I=V.length;Y<I;Y++)V[Y]!==O[Y]&&(i.disableVertexAttribArray(Y),V[Y]=0)}function w(O,V,Y,I,q,j,H){H===!0?i.vertexAttribIPointer(O,V,Y,q,j):i.vertexAttribPointer(O,V,Y,I,q,j)}function b(O,V,Y,I){x();let q=I.attributes,j=Y.getAttributes(),H=V.defaultAttributeValues;for(let st in j){let X=j[st];if(X.location>=0){let tt=q[st];if(tt===void 0&&(st==="instanceMatrix"&&O.instanceMatrix&&(tt=O.instanceMatrix),st==="instanceColor"&&O.instanceColor&&(tt=O.instanceColor)),tt!==void 0){let et=tt.normalized,wt=tt.itemSize,Bt=t.get(tt);if(Bt===void 0)continue;let J=Bt.buffer,_t=Bt.type,Mt=Bt.bytesPerElement,Ct=_t===i.INT||_t===i.UNSIGNED_INT||tt.gpuType===ca;if(tt.isInterleavedBufferAttribute){let xt=tt.data,Vt=xt.isInterleavedBuffer===!0?xt.stride:xt.itemSize,be=tt.offset;if(xt.isInstancedInterleavedBuffer||xt.isInstancedBufferAttribute){for(let Dt=0;Dt<X.locationSize;Dt++)g(X.location+Dt,xt.meshPerAttribute);O.isInstancedMesh!==!0&&I._maxInstanceCount===void 0&&(I._maxInstanceCount=xt.meshPerAttribute*xt.count)}else for(let Dt=0;Dt<X.locationSize;Dt++)p(X.location+Dt);i.bindBuffer(i.ARRAY_BUFFER,J);for(let Dt=0;Dt<X.locationSize;Dt++)w(X.location+Dt,wt/X.locationSize,_t,et,Vt*Mt,(be+wt/X.locationSize*Dt)*Mt,Ct)}else{if(tt.isInstancedBufferAttribute){for(let xt=0;xt<X.locationSize;xt++)g(X.location+xt,tt.meshPerAttribute);O.isInstancedMesh!==!0&&I._maxInstanceCount===void 0&&(I._maxInstanceCount=tt.meshPerAttribute*tt.count)}else for(let xt=0;xt<X.locationSize;xt++)p(X.location+xt);i.bindBuffer(i.ARRAY_BUFFER,J);for(let xt=0;xt<X.locationSize;xt++)w(X.location+xt,wt/X.locationSize,_t,et,wt*Mt,wt/X.locationSize*xt*Mt,Ct)}}else if(H!==void 0){let et=H[st];if(et!==void 0)switch(et.length){case 2:i.vertexAttrib2fv(X.location,et);break;case 3:i.vertexAttrib3fv(X.location,et);break;case 4:i.vertexAttrib4fv(X.location,et);break;default:i.vertexAttrib1fv(X.location,et)}}}}S()}function R(){k();for(let O in n){let V=n[O];for(let Y in V){let I=V[Y];for(let q in I){let j=I[q];for(let H in j)h(j[H].object),delete j[H];delete I[q]}}delete n[O]}}function A(O){if(n[O.id]===void 0)return;let V=n[O.id];for(let Y in V){let I=V[Y];for(let q in I){let j=I[q];for(let H in j)h(j[H].object),delete j[H];delete I[q]}}delete n[O.id]}function _(O){for(let V in n){let Y=n[V];for(let I in Y){let q=Y[I];if(q[O.id]===void 0)continue;let j=q[O.id];for(let H in j)h(j[H].object),delete j[H];delete q[O.id]}}}function E(O){for(let V in n){let Y=n[V],I=O.isInstancedMesh===!0?O.id:0,q=Y[I];if(q!==void 0){for(let j in q){let H=q[j];for(let st in H)h(H[st].object),delete H[st];delete q[j]}delete Y[I],Object.keys(Y).length===0&&delete n[V]}}}function k(){L(),o=!0,r!==s&&(r=s,c(r.object))}function L(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:k,resetDefaultState:L,dispose:R,releaseStatesOfGeometry:A,releaseStatesOfObject:E,releaseStatesOfProgram:_,initAttributes:x,enableAttribute:p,disableUnusedAttributes:S}}function ty(i,t,e){let n;function s(l){n=l}function r(l,c){i.drawArrays(n,l,c),e.update(c,n,1)}function o(l,c,h){h!==0&&(i.drawArraysInstanced(n,l,c,h),e.update(c,n,h))}function a(l,c,h){if(h===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,l,0,c,0,h);let d=0;for(let f=0;f<h;f++)d+=c[f];e.update(d,n,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function ey(i,t,e,n){let s;function r(){if(s!==void 0)return s;if(t.has("EXT_texture_filter_anisotropic")===!0){let _=t.get("EXT_texture_filter_anisotropic");s=i.getParameter(_.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(_){return!(_!==Ke&&n.convert(_)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(_){let E=_===Pn&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(_!==Je&&_!==pn&&!E&&n.convert(_)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE))}function l(_){if(_==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";_="mediump"}return _==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=e.precision!==void 0?e.precision:"highp",h=l(c);h!==c&&(Lt("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=e.reversedDepthBuffer===!0&&t.has("EXT_clip_control"),d=e.logarithmicDepthBuffer===!0&&u===!1;e.reversedDepthBuffer===!0&&u===!1&&Lt("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),e.logarithmicDepthBuffer===!0&&u===!0&&Lt("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let f=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),m=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),x=i.getParameter(i.MAX_TEXTURE_SIZE),p=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),g=i.getParameter(i.MAX_VERTEX_ATTRIBS),S=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),w=i.getParameter(i.MAX_VARYING_VECTORS),b=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),R=i.getParameter(i.MAX_SAMPLES),A=i.getParameter(i.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:d,reversedDepthBuffer:u,maxTextures:f,maxVertexTextures:m,maxTextureSize:x,maxCubemapSize:p,maxAttributes:g,maxVertexUniforms:S,maxVaryings:w,maxFragmentUniforms:b,maxSamples:R,samples:A}}function ny(i){let t=this,e=null,n=0,s=!1,r=!1,o=new We,a=new Ot,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,d){let f=u.length!==0||d||n!==0||s;return s=d,n=u.length,f},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,d){e=h(u,d,0)},this.setState=function(u,d,f){let m=u.clippingPlanes,x=u.clipIntersection,p=u.clipShadows,g=i.get(u);if(!s||m===null||m.length===0||r&&!p)r?h(null):c();else{let S=r?0:n,w=S*4,b=g.clippingState||null;l.value=b,b=h(m,d,w,f);for(let R=0;R!==w;++R)b[R]=e[R];g.clippingState=b,this.numIntersection=x?this.numPlanes:0,this.numPlanes+=S}};function c(){l.value!==e&&(l.value=e,l.needsUpdate=n>0),t.numPlanes=n,t.numIntersection=0}function h(u,d,f,m){let x=u!==null?u.length:0,p=null;if(x!==0){if(p=l.value,m!==!0||p===null){let g=f+x*4,S=d.matrixWorldInverse;a.getNormalMatrix(S),(p===null||p.length<g)&&(p=new Float32Array(g));for(let w=0,b=f;w!==x;++w,b+=4)o.copy(u[w]).applyMatrix4(S,a),o.normal.toArray(p,b),p[b+3]=o.constant}l.value=p,l.needsUpdate=!0}return t.numPlanes=x,t.numIntersection=0,p}}var Ir=class extends cn{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;let n={width:t,height:t,depth:1},s=[n,n,n,n,n,n];this.texture=new cr(s),this._setTextureOptions(e),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;let n={uniforms:{tEquirect:{value:null}},vertexShader:`

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
			`},s=new ys(5,5,5),r=new zn({name:"CubemapFromEquirect",uniforms:$i(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:Ze,blending:Hi});r.uniforms.tEquirect.value=e;let o=new tn(s,r),a=e.minFilter;return e.minFilter===si&&(e.minFilter=$e),new Ms(1,10,this).update(t,o),e.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(t,e=!0,n=!0,s=!0){let r=t.getRenderTarget();for(let o=0;o<6;o++)t.setRenderTarget(this,o),t.clear(e,n,s);t.setRenderTarget(r)}},bf=256,iy=3,sy=20,Xf=256,qf=16,ry=3,oy=new N,ay=new Ut,$a=class i{constructor(t){this._renderer=t,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new Ms(1,10,null),this._boxMesh=new tn(new ys(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(t,e=0,n=.1,s=100,r={}){let{size:o=256,position:a=oy}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),h=this._getSourceTarget(!0);e>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,d=l.autoClearColor,f=l.autoClearDepth,m=l.autoClearStencil,x=t.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,x===null&&(t.background=l.getClearColor(ay));let p=new Ms(n,s,h);return p.position.copy(a),p.update(l,t),l.autoClear=u,l.autoClearColor=d,l.autoClearDepth=f,l.autoClearStencil=m,t.background=x,e>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,e)),this._applyPMREM(c),c}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=Ef(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=wf(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(t,e){return e>0?1-Math.sqrt(1-t/e):0}_setSize(t){this._cubeSize=Math.max(bf,gh(t))}_fromTexture(t,e){t.mapping===Xi||t.mapping===Es?this._setSize(t.image.length===0?bf:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4);let n=e||this._allocateTarget();return this._textureToCubemap(t),this._applyPMREM(n),n}_allocateTarget(){let t=this._cubeSize,e=Sf(t,!1,!1),n=Math.log2(t)-iy;for(let s=0;s<=n;s++)e.texture.mipmaps.push({width:t>>s,height:t>>s});return e.texture.name="PMREM",e.texture.isPMREMTexture=!0,e}_getSourceTarget(t=!1){let e=this._cubeSize,n=this._sourceTarget;return(n===null||n.width!==e||t&&n.depthBuffer===!1)&&(n!==null&&n.dispose(),this._sourceTarget=Sf(e,!0,t)),this._sourceTarget}_compileMaterial(t){this._boxMesh.material=t,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(t,e,n){let s=this._boxMesh,r=this._cubeCamera;s.material=n,r.renderTarget=t,r.activeMipmapLevel=e;let o=t.width>>e;t.viewport.set(0,0,o,o),r.update(this._renderer,s),t.viewport.set(0,0,t.width,t.height)}_textureToCubemap(t){let e;t.mapping===Xi||t.mapping===Es?(this._cubemapMaterial===null&&(this._cubemapMaterial=Ef()),e=this._cubemapMaterial,e.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=wf()),e=this._equirectMaterial),e.uniforms.envMap.value=t,this._renderCube(this._getSourceTarget(),0,e)}_applyPMREM(t){this._ggxMaterial===null&&(this._ggxMaterial=ly(),this._integrationMaterial=cy());let e=this._cubeSize,n=t.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(e/qf);for(let o=0;o<=n;o++){let a=i.lodToRoughness(o,n);if(o>n-ry)r.roughness.value=a,this._renderCube(t,o,this._integrationMaterial);else{let l=a>0?Math.log2(e)+.5*Math.log2(6/(Xf*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=l,this._renderCube(t,o,this._ggxMaterial)}}}_blur(t,e){this._blurMaterial===null&&(this._blurMaterial=hy());let n=this._blurMaterial,s=n.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(e,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(t,0,n),s.envMap.value=t.texture,this._renderCube(r,0,n)}};function Sf(i,t,e){return new Ir(i,{minFilter:si,generateMipmaps:t,type:Pn,colorSpace:tr,depthBuffer:e})}function Lr(i,t,e){return new zn({name:i,uniforms:t,vertexShader:Xt.cube_vert,fragmentShader:e,side:Ze,blending:Hi,depthTest:!1,depthWrite:!1})}function ly(){return Lr("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${Xf}u

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
	`)}function cy(){return Lr("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:qf}},`

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
	`)}function hy(){return Lr("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${sy}
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
	`)}function wf(){return Lr("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

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
	`)}function Ef(){return Lr("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function uy(i){let t=new WeakMap,e=new WeakMap,n=null;function s(d,f=!1){return d==null?null:f?o(d):r(d)}function r(d){if(d&&d.isTexture){let f=d.mapping;if(f===oa||f===aa)if(t.has(d)){let m=t.get(d).texture;return a(m,d.mapping)}else{let m=d.image;if(m&&m.height>0){let x=new Ir(m.height);return x.fromEquirectangularTexture(i,d),t.set(d,x),d.addEventListener("dispose",c),a(x.texture,d.mapping)}else return null}}return d}function o(d){if(d&&d.isTexture&&d.isPMREMTexture!==!0){let f=d.mapping,m=f===oa||f===aa,x=f===Xi||f===Es;if(m||x){let p=e.get(d),g=p!==void 0?p.texture.pmremVersion:0;if(d.isRenderTargetTexture&&d.pmremVersion!==g)return n===null&&(n=new $a(i)),p=m?n.fromEquirectangular(d,p):n.fromCubemap(d,p),p.texture.pmremVersion=d.pmremVersion,e.set(d,p),p.texture;if(p!==void 0)return p.texture;{let S=d.image;return m&&S&&S.height>0||x&&S&&l(S)?(n===null&&(n=new $a(i)),p=m?n.fromEquirectangular(d):n.fromCubemap(d),p.texture.pmremVersion=d.pmremVersion,e.set(d,p),d.addEventListener("dispose",h),p.texture):null}}}return d}function a(d,f){return f===oa?d.mapping=Xi:f===aa&&(d.mapping=Es),d}function l(d){let f=0,m=6;for(let x=0;x<m;x++)d[x]!==void 0&&f++;return f===m}function c(d){let f=d.target;f.removeEventListener("dispose",c);let m=t.get(f);m!==void 0&&(t.delete(f),m.dispose())}function h(d){let f=d.target;f.removeEventListener("dispose",h);let m=e.get(f);m!==void 0&&(e.delete(f),m.dispose())}function u(){t=new WeakMap,e=new WeakMap,n!==null&&(n.dispose(),n=null)}return{get:s,dispose:u}}function dy(i){let t={};function e(n){if(t[n]!==void 0)return t[n];let s=i.getExtension(n);return t[n]=s,s}return{has:function(n){return e(n)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(n){let s=e(n);return s===null&&Js("WebGLRenderer: "+n+" extension not supported."),s}}}function fy(i,t,e,n){let s={},r=new WeakMap,o=new FinalizationRegistry(m=>delete s[m]);function a(m){l(m.target)}function l(m){m.index!==null&&t.remove(m.index);for(let p in m.attributes)t.remove(m.attributes[p]);m.removeEventListener("dispose",a),delete s[m.id],o.unregister(m);let x=r.get(m);x&&(t.remove(x),r.delete(m)),n.releaseStatesOfGeometry(m),m.isInstancedBufferGeometry===!0&&delete m._maxInstanceCount,e.memory.geometries--}function c(m,x){return s[x.id]!==void 0||(x.addEventListener("dispose",a),s[x.id]=new WeakRef(x),o.register(x,x.id,x),e.memory.geometries++),x}function h(m){let x=m.attributes;for(let p in x)t.update(x[p],i.ARRAY_BUFFER)}function u(m){let x=m.index,p=m.attributes.position,g=0;if(p===void 0)return;let S=x!==null?x.array.length:p.array.length/3-1,w=p.count>=65535?ar:or,b=new w(Math.ceil(S/3)*6,1),R=b.array;if(x!==null){let _=x.array;g=x.version;for(let E=0,k=0;E<S;E+=3){let L=_[E+0],O=_[E+1],V=_[E+2];R[k++]=L,R[k++]=O,R[k++]=O,R[k++]=V,R[k++]=V,R[k++]=L}}else{g=p.version;for(let _=0,E=0;_<S;_+=3){let k=_+0,L=_+1,O=_+2;R[E++]=k,R[E++]=L,R[E++]=L,R[E++]=O,R[E++]=O,R[E++]=k}}b.version=g;let A=r.get(m);A&&t.remove(A),r.set(m,b)}function d(m){let x=r.get(m);if(x){let p=m.index;p!==null&&x.version<p.version&&u(m)}else u(m);return r.get(m)}function f(){for(let m in s){let x=s[m].deref();x!==void 0&&l(x)}}return{get:c,update:h,getWireframeAttribute:d,dispose:f}}function py(i,t,e){let n;function s(u){n=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,d){i.drawElements(n,d,r,u*o),e.update(d,n,1)}function c(u,d,f){f!==0&&(i.drawElementsInstanced(n,d,r,u*o,f),e.update(d,n,f))}function h(u,d,f){if(f===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,d,0,r,u,0,f);let x=0;for(let p=0;p<f;p++)x+=d[p];e.update(x,n,1)}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function my(i){let t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,o,a){switch(e.calls++,o){case i.TRIANGLES:e.triangles+=a*(r/3);break;case i.LINES:e.lines+=a*(r/2);break;case i.LINE_STRIP:e.lines+=a*(r-1);break;case i.LINE_LOOP:e.lines+=a*r;break;case i.POINTS:e.points+=a*r;break;default:Nt("WebGLInfo: Unknown draw mode:",o);break}}function s(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:s,update:n}}function gy(i,t,e){let n=new WeakMap,s=new ge;function r(o,a,l){let c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,d=n.get(a);if(d===void 0||d.count!==u){let k=function(){_.dispose(),n.delete(a),a.removeEventListener("dispose",k)};d!==void 0&&d.texture.dispose();let f=a.morphAttributes.position!==void 0,m=a.morphAttributes.normal!==void 0,x=a.morphAttributes.color!==void 0,p=a.morphAttributes.position||[],g=a.morphAttributes.normal||[],S=a.morphAttributes.color||[],w=0;f===!0&&(w=1),m===!0&&(w=2),x===!0&&(w=3);let b=a.attributes.position.count*w,R=1;b>t.maxTextureSize&&(R=Math.ceil(b/t.maxTextureSize),b=t.maxTextureSize);let A=new Float32Array(b*R*4*u),_=new sr(A,b,R,u);_.type=pn,_.needsUpdate=!0;let E=w*4;for(let L=0;L<u;L++){let O=p[L],V=g[L],Y=S[L],I=b*R*4*L;for(let q=0;q<O.count;q++){let j=q*E;f===!0&&(s.fromBufferAttribute(O,q),A[I+j+0]=s.x,A[I+j+1]=s.y,A[I+j+2]=s.z,A[I+j+3]=0),m===!0&&(s.fromBufferAttribute(V,q),A[I+j+4]=s.x,A[I+j+5]=s.y,A[I+j+6]=s.z,A[I+j+7]=0),x===!0&&(s.fromBufferAttribute(Y,q),A[I+j+8]=s.x,A[I+j+9]=s.y,A[I+j+10]=s.z,A[I+j+11]=Y.itemSize===4?s.w:1)}}d={count:u,texture:_,size:new It(b,R)},n.set(a,d),a.addEventListener("dispose",k)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",o.morphTexture,e);else{let f=0;for(let x=0;x<c.length;x++)f+=c[x];let m=a.morphTargetsRelative?1:1-f;l.getUniforms().setValue(i,"morphTargetBaseInfluence",m),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",d.texture,e),l.getUniforms().setValue(i,"morphTargetsTextureSize",d.size)}return{update:r}}function _y(i,t,e,n,s){let r=new WeakMap;function o(c){let h=s.render.frame,u=c.geometry,d=t.get(c,u);if(r.get(d)!==h&&(t.update(d),r.set(d,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(e.update(c.instanceMatrix,i.ARRAY_BUFFER),c.instanceColor!==null&&e.update(c.instanceColor,i.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let f=c.skeleton;r.get(f)!==h&&(f.update(),r.set(f,h))}return d}function a(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),n.releaseStatesOfObject(h),e.remove(h.instanceMatrix),h.instanceColor!==null&&e.remove(h.instanceColor)}return{update:o,dispose:a}}var xy={[Zc]:"LINEAR_TONE_MAPPING",[Jc]:"REINHARD_TONE_MAPPING",[Kc]:"CINEON_TONE_MAPPING",[jc]:"ACES_FILMIC_TONE_MAPPING",[th]:"AGX_TONE_MAPPING",[eh]:"NEUTRAL_TONE_MAPPING",[Qc]:"CUSTOM_TONE_MAPPING"};function yy(i,t,e,n,s,r){let o=new cn(t,e,{type:i,depthBuffer:s,stencilBuffer:r,samples:n?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,h=new Ye;h.setAttribute("position",new qe([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new qe([0,2,0,0,2,0],2));let u=new Vn({uniforms:{tDiffuse:{value:null}},vertexShader:`
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
			}`,depthTest:!1,depthWrite:!1}),d=new tn(h,u),f=new sa(-1,1,1,-1,0,1),m=null,x=null,p=!1,g,S=null,w=[],b=!1;this.setSize=function(R,A){o.setSize(R,A),a!==null&&a.setSize(R,A),l!==null&&l.setSize(R,A);for(let _=0;_<w.length;_++){let E=w[_];E.setSize&&E.setSize(R,A)}},this.setEffects=function(R){w=R,b=w.length>0&&w[0].isRenderPass===!0;let A=o.width,_=o.height;w.length>0&&a===null&&(a=new cn(A,_,{type:Pn,depthBuffer:!1,stencilBuffer:!1}),l=new cn(A,_,{type:Pn,depthBuffer:!1,stencilBuffer:!1}));let E=s===!0&&w.some(k=>k.needsDepthTexture===!0);E!==(o.depthTexture!==null)&&(E===!0&&c===null&&(c=new ii(A,_),r===!0&&(c.format=ri,c.type=qi)),o.dispose(),o.depthTexture=E?c:null,o.resolveDepthBuffer=E,o.storeMultisampledDepthBuffer=E);for(let k=0;k<w.length;k++){let L=w[k];L.setSize&&L.setSize(A,_),E&&L.needsDepthTexture===!0&&L.setDepthTexture&&L.setDepthTexture(c)}},this.begin=function(R,A){if(p||R.toneMapping===Hn&&w.length===0)return!1;if(S=A,A!==null){let _=A.width,E=A.height;(o.width!==_||o.height!==E)&&this.setSize(_,E)}return b===!1&&R.setRenderTarget(o),g=R.toneMapping,R.toneMapping=Hn,!0},this.hasRenderPass=function(){return b},this.end=function(R,A){R.toneMapping=g,p=!0;let _=o,E=a;for(let k=0;k<w.length;k++){let L=w[k];L.enabled!==!1&&(L.render(R,E,_,A),L.needsSwap!==!1&&(_=E,E=E===a?l:a))}if(m!==R.outputColorSpace||x!==R.toneMapping){m=R.outputColorSpace,x=R.toneMapping,u.defines={},Kt.getTransfer(m)===ie&&(u.defines.SRGB_TRANSFER="");let k=xy[x];k&&(u.defines[k]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=_.texture,R.setRenderTarget(S),R.render(d,f),S=null,p=!1},this.isCompositing=function(){return p},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var $f=new Qe,Yf=new ii(1,1),Zf=new hr(1),Jf=new sr,Kf=new Go,jf=new cr,Tf=[],Af=[],Rf=new Float32Array(16),Cf=new Float32Array(9),Pf=new Float32Array(4);function Cs(i,t,e){let n=i[0];if(n<=0||n>0)return i;let s=t*e,r=Tf[s];if(r===void 0&&(r=new Float32Array(s),Tf[s]=r),t!==0){n.toArray(r,0);for(let o=1,a=0;o!==t;++o)a+=e,i[o].toArray(r,a)}return r}function Ae(i,t){if(i.length!==t.length)return!1;for(let e=0,n=i.length;e<n;e++)if(i[e]!==t[e])return!1;return!0}function Re(i,t){for(let e=0,n=t.length;e<n;e++)i[e]=t[e]}function Za(i,t){let e=Af[t];e===void 0&&(e=new Int32Array(t),Af[t]=e);for(let n=0;n!==t;++n)e[n]=i.allocateTextureUnit();return e}function vy(i,t){let e=this.cache;e[0]!==t&&(i.uniform1f(this.addr,t),e[0]=t)}function My(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Ae(e,t))return;i.uniform2fv(this.addr,t),Re(e,t)}}function by(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(i.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(Ae(e,t))return;i.uniform3fv(this.addr,t),Re(e,t)}}function Sy(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Ae(e,t))return;i.uniform4fv(this.addr,t),Re(e,t)}}function wy(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(Ae(e,t))return;i.uniformMatrix2fv(this.addr,!1,t),Re(e,t)}else{if(Ae(e,n))return;Pf.set(n),i.uniformMatrix2fv(this.addr,!1,Pf),Re(e,n)}}function Ey(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(Ae(e,t))return;i.uniformMatrix3fv(this.addr,!1,t),Re(e,t)}else{if(Ae(e,n))return;Cf.set(n),i.uniformMatrix3fv(this.addr,!1,Cf),Re(e,n)}}function Ty(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(Ae(e,t))return;i.uniformMatrix4fv(this.addr,!1,t),Re(e,t)}else{if(Ae(e,n))return;Rf.set(n),i.uniformMatrix4fv(this.addr,!1,Rf),Re(e,n)}}function Ay(i,t){let e=this.cache;e[0]!==t&&(i.uniform1i(this.addr,t),e[0]=t)}function Ry(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Ae(e,t))return;i.uniform2iv(this.addr,t),Re(e,t)}}function Cy(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Ae(e,t))return;i.uniform3iv(this.addr,t),Re(e,t)}}function Py(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Ae(e,t))return;i.uniform4iv(this.addr,t),Re(e,t)}}function Iy(i,t){let e=this.cache;e[0]!==t&&(i.uniform1ui(this.addr,t),e[0]=t)}function Ly(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Ae(e,t))return;i.uniform2uiv(this.addr,t),Re(e,t)}}function Dy(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Ae(e,t))return;i.uniform3uiv(this.addr,t),Re(e,t)}}function Ny(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Ae(e,t))return;i.uniform4uiv(this.addr,t),Re(e,t)}}function Ja(i){return i.version===0&&(i.compareFunction=fh,i.needsUpdate=!0),i}function Oy(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_2D_SHADOW?r=Ja(Yf):r=$f,e.setTexture2D(t||r,s)}function Uy(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture3D(t||Kf,s)}function Fy(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_CUBE_SHADOW?r=Ja(Zf):r=jf,e.setTextureCube(t||r,s)}function By(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture2DArray(t||Jf,s)}function ky(i){switch(i){case 5126:return vy;case 35664:return My;case 35665:return by;case 35666:return Sy;case 35674:return wy;case 35675:return Ey;case 35676:return Ty;case 5124:case 35670:return Ay;case 35667:case 35671:return Ry;case 35668:case 35672:return Cy;case 35669:case 35673:return Py;case 5125:return Iy;case 36294:return Ly;case 36295:return Dy;case 36296:return Ny;case 35678:case 36198:case 36298:case 36306:case 35682:return Oy;case 35679:case 36299:case 36307:return Uy;case 35680:case 36300:case 36308:case 36293:return Fy;case 36289:case 36303:case 36311:case 36292:return By}}function zy(i,t){i.uniform1fv(this.addr,t)}function Vy(i,t){let e=Cs(t,this.size,2);i.uniform2fv(this.addr,e)}function Gy(i,t){let e=Cs(t,this.size,3);i.uniform3fv(this.addr,e)}function Hy(i,t){let e=Cs(t,this.size,4);i.uniform4fv(this.addr,e)}function Wy(i,t){let e=Cs(t,this.size,4);i.uniformMatrix2fv(this.addr,!1,e)}function Xy(i,t){let e=Cs(t,this.size,9);i.uniformMatrix3fv(this.addr,!1,e)}function qy(i,t){let e=Cs(t,this.size,16);i.uniformMatrix4fv(this.addr,!1,e)}function $y(i,t){i.uniform1iv(this.addr,t)}function Yy(i,t){i.uniform2iv(this.addr,t)}function Zy(i,t){i.uniform3iv(this.addr,t)}function Jy(i,t){i.uniform4iv(this.addr,t)}function Ky(i,t){i.uniform1uiv(this.addr,t)}function jy(i,t){i.uniform2uiv(this.addr,t)}function Qy(i,t){i.uniform3uiv(this.addr,t)}function tv(i,t){i.uniform4uiv(this.addr,t)}function ev(i,t,e){let n=this.cache,s=t.length,r=Za(e,s);Ae(n,r)||(i.uniform1iv(this.addr,r),Re(n,r));let o;this.type===i.SAMPLER_2D_SHADOW?o=Ja(Yf):o=$f;for(let a=0;a!==s;++a)e.setTexture2D(t[a]||o,r[a])}function nv(i,t,e){let n=this.cache,s=t.length,r=Za(e,s);Ae(n,r)||(i.uniform1iv(this.addr,r),Re(n,r));for(let o=0;o!==s;++o)e.setTexture3D(t[o]||Kf,r[o])}function iv(i,t,e){let n=this.cache,s=t.length,r=Za(e,s);Ae(n,r)||(i.uniform1iv(this.addr,r),Re(n,r));let o;this.type===i.SAMPLER_CUBE_SHADOW?o=Ja(Zf):o=jf;for(let a=0;a!==s;++a)e.setTextureCube(t[a]||o,r[a])}function sv(i,t,e){let n=this.cache,s=t.length,r=Za(e,s);Ae(n,r)||(i.uniform1iv(this.addr,r),Re(n,r));for(let o=0;o!==s;++o)e.setTexture2DArray(t[o]||Jf,r[o])}function rv(i){switch(i){case 5126:return zy;case 35664:return Vy;case 35665:return Gy;case 35666:return Hy;case 35674:return Wy;case 35675:return Xy;case 35676:return qy;case 5124:case 35670:return $y;case 35667:case 35671:return Yy;case 35668:case 35672:return Zy;case 35669:case 35673:return Jy;case 5125:return Ky;case 36294:return jy;case 36295:return Qy;case 36296:return tv;case 35678:case 36198:case 36298:case 36306:case 35682:return ev;case 35679:case 36299:case 36307:return nv;case 35680:case 36300:case 36308:case 36293:return iv;case 36289:case 36303:case 36311:case 36292:return sv}}var Eh=class{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.setValue=ky(e.type)}},Th=class{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=rv(e.type)}},Ah=class{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,n){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(t,e[a.id],n)}}},Sh=/(\w+)(\])?(\[|\.)?/g;function If(i,t){i.seq.push(t),i.map[t.id]=t}function ov(i,t,e){let n=i.name,s=n.length;for(Sh.lastIndex=0;;){let r=Sh.exec(n),o=Sh.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){If(e,c===void 0?new Eh(a,i,t):new Th(a,i,t));break}else{let u=e.map[a];u===void 0&&(u=new Ah(a),If(e,u)),e=u}}}var Rs=class{constructor(t,e){this.seq=[],this.map={};let n=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let o=0;o<n;++o){let a=t.getActiveUniform(e,o),l=t.getUniformLocation(e,a.name);ov(a,l,this)}let s=[],r=[];for(let o of this.seq)o.type===t.SAMPLER_2D_SHADOW||o.type===t.SAMPLER_CUBE_SHADOW||o.type===t.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(t,e,n,s){let r=this.map[e];r!==void 0&&r.setValue(t,n,s)}setOptional(t,e,n){let s=e[n];s!==void 0&&this.setValue(t,n,s)}static upload(t,e,n,s){for(let r=0,o=e.length;r!==o;++r){let a=e[r],l=n[a.id];l.needsUpdate!==!1&&a.setValue(t,l.value,s)}}static seqWithValue(t,e){let n=[];for(let s=0,r=t.length;s!==r;++s){let o=t[s];o.id in e&&n.push(o)}return n}};function Lf(i,t,e){let n=i.createShader(t);return i.shaderSource(n,e),i.compileShader(n),n}var av=37297,lv=0;function cv(i,t){let e=i.split(`
`),n=[],s=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let o=s;o<r;o++){let a=o+1;n.push(`${a===t?">":" "} ${a}: ${e[o]}`)}return n.join(`
`)}var Df=new Ot;function hv(i){Kt._getMatrix(Df,Kt.workingColorSpace,i);let t=`mat3( ${Df.elements.map(e=>e.toFixed(4))} )`;switch(Kt.getTransfer(i)){case er:return[t,"LinearTransferOETF"];case ie:return[t,"sRGBTransferOETF"];default:return Lt("WebGLProgram: Unsupported color space: ",i),[t,"LinearTransferOETF"]}}function Nf(i,t,e){let n=i.getShaderParameter(t,i.COMPILE_STATUS),r=(i.getShaderInfoLog(t)||"").trim();if(n&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return e.toUpperCase()+`

`+r+`

`+cv(i.getShaderSource(t),a)}else return r}function uv(i,t){let e=hv(t);return[`vec4 ${i}( vec4 value ) {`,`	return ${e[1]}( vec4( ${e[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var dv={[Zc]:"Linear",[Jc]:"Reinhard",[Kc]:"Cineon",[jc]:"ACESFilmic",[th]:"AgX",[eh]:"Neutral",[Qc]:"Custom"};function fv(i,t){let e=dv[t];return e===void 0?(Lt("WebGLProgram: Unsupported toneMapping:",t),"vec3 "+i+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+i+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}var qa=new N;function pv(){Kt.getLuminanceCoefficients(qa);let i=qa.x.toFixed(4),t=qa.y.toFixed(4),e=qa.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function mv(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(Pr).join(`
`)}function gv(i){let t=[];for(let e in i){let n=i[e];n!==!1&&t.push("#define "+e+" "+n)}return t.join(`
`)}function _v(i,t){let e={},n=i.getProgramParameter(t,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){let r=i.getActiveAttrib(t,s),o=r.name,a=1;r.type===i.FLOAT_MAT2&&(a=2),r.type===i.FLOAT_MAT3&&(a=3),r.type===i.FLOAT_MAT4&&(a=4),e[o]={type:r.type,location:i.getAttribLocation(t,o),locationSize:a}}return e}function Pr(i){return i!==""}function Of(i,t){let e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return i.replace(/NUM_SUN_LIGHTS/g,t.numSunLights).replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,t.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,t.numLightProbeGrids)}function Uf(i,t){return i.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}var xv=/^[ \t]*#include +<([\w\d./]+)>/gm;function Rh(i){return i.replace(xv,yv)}function yv(i,t){let e=Xt[t];if(e===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+t+">");return Rh(e)}var vv=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function Ff(i){return i.replace(vv,Mv)}function Mv(i,t,e,n){let s="";for(let r=parseInt(t);r<parseInt(e);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function Bf(i){let t=`precision ${i.precision} float;
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
#define LOW_PRECISION`),t}var bv={[Mr]:"SHADOWMAP_TYPE_PCF",[Ss]:"SHADOWMAP_TYPE_VSM"};function Sv(i){return bv[i.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var wv={[Es]:"ENVMAP_MODE_REFRACTION"};function Ev(i){return i.envMap===!1?"ENVMAP_MODE_REFLECTION":wv[i.envMapMode]||"ENVMAP_MODE_REFLECTION"}var Tv={[Yc]:"ENVMAP_BLENDING_MULTIPLY",[Zd]:"ENVMAP_BLENDING_MIX",[Jd]:"ENVMAP_BLENDING_ADD"};function Av(i){return i.envMap===!1?"ENVMAP_BLENDING_NONE":Tv[i.combine]||"ENVMAP_BLENDING_NONE"}function Rv(i,t,e,n){let s=i.getContext(),r=e.defines,o=e.vertexShader,a=e.fragmentShader,l=Sv(e),c=e.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=Ev(e),u=Av(e),d=mv(e),f=gv(r),m=s.createProgram(),x,p,g=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(x=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f].filter(Pr).join(`
`),x.length>0&&(x+=`
`),p=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f].filter(Pr).join(`
`),p.length>0&&(p+=`
`)):(x=[Bf(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+h:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+e.diffuseRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexNormals?"#define HAS_NORMAL":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(Pr).join(`
`),p=[Bf(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+c:"",e.envMap?"#define "+h:"",e.envMap?"#define "+u:"",e.envMapPMREM?"#define ENVMAP_MAX_LOD "+e.envMapMaxLod+".0":"",e.envMapPMREM?"#define ENVMAP_SIZE "+e.envMapSize+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.retroreflection?"#define USE_RETROREFLECTION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor?"#define USE_COLOR":"",e.vertexAlphas||e.batchingColor?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==Hn?"#define TONE_MAPPING":"",e.toneMapping!==Hn?Xt.tonemapping_pars_fragment:"",e.toneMapping!==Hn?fv("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",Xt.colorspace_pars_fragment,uv("linearToOutputTexel",e.outputColorSpace),pv(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(Pr).join(`
`)),o=Rh(o),o=Of(o,e),o=Uf(o,e),a=Rh(a),a=Of(a,e),a=Uf(a,e),o=Ff(o),a=Ff(a),e.isRawShaderMaterial!==!0&&(g=`#version 300 es
`,x=[d,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+x,p=["#define varying in",e.glslVersion===ai?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===ai?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+p);let S=g+x+o,w=g+p+a,b=Lf(s,s.VERTEX_SHADER,S),R=Lf(s,s.FRAGMENT_SHADER,w);s.attachShader(m,b),s.attachShader(m,R),e.index0AttributeName!==void 0?s.bindAttribLocation(m,0,e.index0AttributeName):e.hasPositionAttribute===!0&&s.bindAttribLocation(m,0,"position"),s.linkProgram(m);function A(L){if(i.debug.checkShaderErrors){let O=s.getProgramInfoLog(m)||"",V=s.getShaderInfoLog(b)||"",Y=s.getShaderInfoLog(R)||"",I=O.trim(),q=V.trim(),j=Y.trim(),H=!0,st=!0;if(s.getProgramParameter(m,s.LINK_STATUS)===!1)if(H=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,m,b,R);else{let X=Nf(s,b,"vertex"),tt=Nf(s,R,"fragment");Nt("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(m,s.VALIDATE_STATUS)+`

Material Name: `+L.name+`
Material Type: `+L.type+`

Program Info Log: `+I+`
`+X+`
`+tt)}else I!==""?Lt("WebGLProgram: Program Info Log:",I):(q===""||j==="")&&(st=!1);st&&(L.diagnostics={runnable:H,programLog:I,vertexShader:{log:q,prefix:x},fragmentShader:{log:j,prefix:p}})}s.deleteShader(b),s.deleteShader(R),_=new Rs(s,m),E=_v(s,m)}let _;this.getUniforms=function(){return _===void 0&&A(this),_};let E;this.getAttributes=function(){return E===void 0&&A(this),E};let k=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return k===!1&&(k=s.getProgramParameter(m,av)),k},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(m),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=lv++,this.cacheKey=t,this.usedTimes=1,this.program=m,this.vertexShader=b,this.fragmentShader=R,this}var Cv=0,Ch=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t,e,n){let s=this._getShaderCacheForMaterial(t);return s.has(e)===!1&&(s.add(e),e.usedTimes++),s.has(n)===!1&&(s.add(n),n.usedTimes++),this}remove(t){let e=this.materialCache.get(t);for(let n of e)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(t),this}getVertexShaderStage(t){return this._getShaderStage(t.vertexShader)}getFragmentShaderStage(t){return this._getShaderStage(t.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){let e=this.materialCache,n=e.get(t);return n===void 0&&(n=new Set,e.set(t,n)),n}_getShaderStage(t){let e=this.shaderCache,n=e.get(t);return n===void 0&&(n=new Ph(t),e.set(t,n)),n}},Ph=class{constructor(t){this.id=Cv++,this.code=t,this.usedTimes=0}};function Pv(i){return i===Ci||i===Ar||i===Rr}function Iv(i,t,e,n,s,r){let o=new _s,a=new Ch,l=new Set,c=[],h=new Map,u=n.logarithmicDepthBuffer,d={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function f(_){return l.add(_),_===0?"uv":`uv${_}`}function m(_,E,k,L,O,V){let Y=L.fog,I=O.geometry,q=_.isMeshStandardMaterial||_.isMeshLambertMaterial||_.isMeshPhongMaterial?L.environment:null,j=_.isMeshStandardMaterial||_.isMeshLambertMaterial&&!_.envMap||_.isMeshPhongMaterial&&!_.envMap,H=t.get(_.envMap||q,j),st=d[_.type],X=n.precision;_.precision!==null&&(X=n.getMaxPrecision(_.precision),X!==_.precision&&Lt("WebGLProgram.getParameters:",_.precision,"not supported, using",X,"instead."));let tt=I.morphAttributes.position||I.morphAttributes.normal||I.morphAttributes.color,et=tt!==void 0?tt.length:0,wt=0;I.morphAttributes.position!==void 0&&(wt=1),I.morphAttributes.normal!==void 0&&(wt=2),I.morphAttributes.color!==void 0&&(wt=3);let Bt,J,_t,Mt;if(st){let mt=Xn[st];Bt=mt.vertexShader,J=mt.fragmentShader}else{Bt=_.vertexShader,J=_.fragmentShader;let mt=a.getVertexShaderStage(_),re=a.getFragmentShaderStage(_);a.update(_,mt,re),_t=mt.id,Mt=re.id}let Ct=i.getRenderTarget(),xt=i.state.buffers.depth.getReversed(),Vt=O.isInstancedMesh===!0,be=O.isBatchedMesh===!0,Dt=!!_.map,se=!!_.matcap,oe=!!H,Yt=oe&&H.isPMREMTexture===!0,Oe=!!_.aoMap,Ee=!!_.lightMap,je=!!_.bumpMap&&_.wireframe===!1,fe=!!_.normalMap,On=!!_.displacementMap,Pe=!!_.emissiveMap,gn=!!_.metalnessMap,_n=!!_.roughnessMap,xn=_.anisotropy>0,D=_.clearcoat>0,yn=_.diffuseRoughness>0,ue=_.dispersion>0,de=_.retroreflectivity>0,pt=_.iridescence>0,Te=_.sheen>0,Pt=_.transmission>0,Ft=xn&&!!_.anisotropyMap,T=D&&!!_.clearcoatMap,y=D&&!!_.clearcoatNormalMap,F=D&&!!_.clearcoatRoughnessMap,it=yn&&!!_.diffuseRoughnessMap,Q=pt&&!!_.iridescenceMap,at=pt&&!!_.iridescenceThicknessMap,dt=Te&&!!_.sheenColorMap,$=Te&&!!_.sheenRoughnessMap,Z=!!_.specularMap,ct=!!_.specularColorMap,C=!!_.specularIntensityMap,K=Pt&&!!_.transmissionMap,W=Pt&&!!_.thicknessMap,ht=!!_.gradientMap,ot=!!_.alphaMap,lt=_.alphaTest>0,At=!!_.alphaHash,Wt=!!_.extensions,rt=Hn;_.toneMapped&&(Ct===null||Ct.isXRRenderTarget===!0)&&(rt=i.toneMapping);let Rt=Yt?H.isCompressedCubeTexture?H.image[0].mipmaps:H.mipmaps:null,Ht={shaderID:st,shaderType:_.type,shaderName:_.name,vertexShader:Bt,fragmentShader:J,defines:_.defines,customVertexShaderID:_t,customFragmentShaderID:Mt,isRawShaderMaterial:_.isRawShaderMaterial===!0,glslVersion:_.glslVersion,precision:X,batching:be,batchingColor:be&&O._colorsTexture!==null,instancing:Vt,instancingColor:Vt&&O.instanceColor!==null,instancingMorph:Vt&&O.morphTexture!==null,outputColorSpace:Ct===null?i.outputColorSpace:Ct.isXRRenderTarget===!0?Ct.texture.colorSpace:Kt.workingColorSpace,alphaToCoverage:!!_.alphaToCoverage,map:Dt,matcap:se,envMap:oe,envMapMode:oe&&H.mapping,envMapPMREM:Yt,envMapMaxLod:Yt?Rt.length-1:null,envMapSize:Yt?Rt[0].width:null,aoMap:Oe,lightMap:Ee,bumpMap:je,normalMap:fe,displacementMap:On,emissiveMap:Pe,normalMapObjectSpace:fe&&_.normalMapType===Qd,normalMapTangentSpace:fe&&_.normalMapType===hh,packedNormalMap:fe&&_.normalMapType===hh&&Pv(_.normalMap.format),metalnessMap:gn,roughnessMap:_n,anisotropy:xn,anisotropyMap:Ft,clearcoat:D,clearcoatMap:T,clearcoatNormalMap:y,clearcoatRoughnessMap:F,diffuseRoughness:yn,diffuseRoughnessMap:it,dispersion:ue,retroreflection:de,iridescence:pt,iridescenceMap:Q,iridescenceThicknessMap:at,sheen:Te,sheenColorMap:dt,sheenRoughnessMap:$,specularMap:Z,specularColorMap:ct,specularIntensityMap:C,transmission:Pt,transmissionMap:K,thicknessMap:W,gradientMap:ht,opaque:_.transparent===!1&&_.blending===ws&&_.alphaToCoverage===!1,alphaMap:ot,alphaTest:lt,alphaHash:At,combine:_.combine,mapUv:Dt&&f(_.map.channel),aoMapUv:Oe&&f(_.aoMap.channel),lightMapUv:Ee&&f(_.lightMap.channel),bumpMapUv:je&&f(_.bumpMap.channel),normalMapUv:fe&&f(_.normalMap.channel),displacementMapUv:On&&f(_.displacementMap.channel),emissiveMapUv:Pe&&f(_.emissiveMap.channel),metalnessMapUv:gn&&f(_.metalnessMap.channel),roughnessMapUv:_n&&f(_.roughnessMap.channel),anisotropyMapUv:Ft&&f(_.anisotropyMap.channel),clearcoatMapUv:T&&f(_.clearcoatMap.channel),clearcoatNormalMapUv:y&&f(_.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:F&&f(_.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:it&&f(_.diffuseRoughnessMap.channel),iridescenceMapUv:Q&&f(_.iridescenceMap.channel),iridescenceThicknessMapUv:at&&f(_.iridescenceThicknessMap.channel),sheenColorMapUv:dt&&f(_.sheenColorMap.channel),sheenRoughnessMapUv:$&&f(_.sheenRoughnessMap.channel),specularMapUv:Z&&f(_.specularMap.channel),specularColorMapUv:ct&&f(_.specularColorMap.channel),specularIntensityMapUv:C&&f(_.specularIntensityMap.channel),transmissionMapUv:K&&f(_.transmissionMap.channel),thicknessMapUv:W&&f(_.thicknessMap.channel),alphaMapUv:ot&&f(_.alphaMap.channel),vertexTangents:!!I.attributes.tangent&&(fe||xn),vertexNormals:!!I.attributes.normal,vertexColors:_.vertexColors,vertexAlphas:_.vertexColors===!0&&!!I.attributes.color&&I.attributes.color.itemSize===4,pointsUvs:O.isPoints===!0&&!!I.attributes.uv&&(Dt||ot),fog:!!Y,useFog:_.fog===!0,fogExp2:!!Y&&Y.isFogExp2,flatShading:_.wireframe===!1&&(_.flatShading===!0||I.attributes.normal===void 0&&fe===!1&&(_.isMeshLambertMaterial||_.isMeshPhongMaterial||_.isMeshStandardMaterial||_.isMeshPhysicalMaterial)),sizeAttenuation:_.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:xt,skinning:O.isSkinnedMesh===!0,hasPositionAttribute:I.attributes.position!==void 0,morphTargets:I.morphAttributes.position!==void 0,morphNormals:I.morphAttributes.normal!==void 0,morphColors:I.morphAttributes.color!==void 0,morphTargetsCount:et,morphTextureStride:wt,numSunLights:E.sun.length,numDirLights:E.directional.length,numPointLights:E.point.length,numSpotLights:E.spot.length,numSpotLightMaps:E.spotLightMap.length,numRectAreaLights:E.rectArea.length,numHemiLights:E.hemi.length,numSunLightShadows:E.sunShadowMap.length,numDirLightShadows:E.directionalShadowMap.length,numPointLightShadows:E.pointShadowMap.length,numSpotLightShadows:E.spotShadowMap.length,numSpotLightShadowsWithMaps:E.numSpotLightShadowsWithMaps,numLightProbes:E.numLightProbes,numLightProbeGrids:V.filter(mt=>mt.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:_.dithering,shadowMapEnabled:i.shadowMap.enabled&&k.length>0,shadowMapType:i.shadowMap.type,toneMapping:rt,decodeVideoTexture:Dt&&_.map.isVideoTexture===!0&&Kt.getTransfer(_.map.colorSpace)===ie,decodeVideoTextureEmissive:Pe&&_.emissiveMap.isVideoTexture===!0&&Kt.getTransfer(_.emissiveMap.colorSpace)===ie,premultipliedAlpha:_.premultipliedAlpha,doubleSided:_.side===fn,flipSided:_.side===Ze,useDepthPacking:_.depthPacking>=0,depthPacking:_.depthPacking||0,index0AttributeName:_.index0AttributeName,extensionClipCullDistance:Wt&&_.extensions.clipCullDistance===!0&&e.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Wt&&_.extensions.multiDraw===!0||be)&&e.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:e.has("KHR_parallel_shader_compile"),customProgramCacheKey:_.customProgramCacheKey()};return Ht.vertexUv1s=l.has(1),Ht.vertexUv2s=l.has(2),Ht.vertexUv3s=l.has(3),l.clear(),Ht}function x(_){let E=[];if(_.shaderID?E.push(_.shaderID):(E.push(_.customVertexShaderID),E.push(_.customFragmentShaderID)),_.defines!==void 0)for(let k in _.defines)E.push(k),E.push(_.defines[k]);return _.isRawShaderMaterial===!1&&(p(E,_),g(E,_),E.push(i.outputColorSpace)),E.push(_.customProgramCacheKey),E.join()}function p(_,E){_.push(E.precision),_.push(E.outputColorSpace),_.push(E.envMapMode),_.push(E.envMapPMREM),_.push(E.envMapMaxLod),_.push(E.envMapSize),_.push(E.mapUv),_.push(E.alphaMapUv),_.push(E.lightMapUv),_.push(E.aoMapUv),_.push(E.bumpMapUv),_.push(E.normalMapUv),_.push(E.displacementMapUv),_.push(E.emissiveMapUv),_.push(E.metalnessMapUv),_.push(E.roughnessMapUv),_.push(E.anisotropyMapUv),_.push(E.clearcoatMapUv),_.push(E.clearcoatNormalMapUv),_.push(E.clearcoatRoughnessMapUv),_.push(E.diffuseRoughnessMapUv),_.push(E.iridescenceMapUv),_.push(E.iridescenceThicknessMapUv),_.push(E.sheenColorMapUv),_.push(E.sheenRoughnessMapUv),_.push(E.specularMapUv),_.push(E.specularColorMapUv),_.push(E.specularIntensityMapUv),_.push(E.transmissionMapUv),_.push(E.thicknessMapUv),_.push(E.combine),_.push(E.fogExp2),_.push(E.sizeAttenuation),_.push(E.morphTargetsCount),_.push(E.numSunLights),_.push(E.numDirLights),_.push(E.numPointLights),_.push(E.numSpotLights),_.push(E.numSpotLightMaps),_.push(E.numHemiLights),_.push(E.numRectAreaLights),_.push(E.numSunLightShadows),_.push(E.numDirLightShadows),_.push(E.numPointLightShadows),_.push(E.numSpotLightShadows),_.push(E.numSpotLightShadowsWithMaps),_.push(E.numLightProbes),_.push(E.numLightProbeGrids),_.push(E.shadowMapType),_.push(E.toneMapping),_.push(E.numClippingPlanes),_.push(E.numClipIntersection),_.push(E.depthPacking)}function g(_,E){o.disableAll(),E.instancing&&o.enable(0),E.instancingColor&&o.enable(1),E.instancingMorph&&o.enable(2),E.matcap&&o.enable(3),E.envMap&&o.enable(4),E.normalMapObjectSpace&&o.enable(5),E.normalMapTangentSpace&&o.enable(6),E.clearcoat&&o.enable(7),E.iridescence&&o.enable(8),E.alphaTest&&o.enable(9),E.vertexColors&&o.enable(10),E.vertexAlphas&&o.enable(11),E.vertexUv1s&&o.enable(12),E.vertexUv2s&&o.enable(13),E.vertexUv3s&&o.enable(14),E.vertexTangents&&o.enable(15),E.anisotropy&&o.enable(16),E.alphaHash&&o.enable(17),E.batching&&o.enable(18),E.dispersion&&o.enable(19),E.retroreflection&&o.enable(24),E.diffuseRoughness&&o.enable(25),E.batchingColor&&o.enable(20),E.gradientMap&&o.enable(21),E.packedNormalMap&&o.enable(22),E.vertexNormals&&o.enable(23),_.push(o.mask),o.disableAll(),E.fog&&o.enable(0),E.useFog&&o.enable(1),E.flatShading&&o.enable(2),E.logarithmicDepthBuffer&&o.enable(3),E.reversedDepthBuffer&&o.enable(4),E.skinning&&o.enable(5),E.morphTargets&&o.enable(6),E.morphNormals&&o.enable(7),E.morphColors&&o.enable(8),E.premultipliedAlpha&&o.enable(9),E.shadowMapEnabled&&o.enable(10),E.doubleSided&&o.enable(11),E.flipSided&&o.enable(12),E.useDepthPacking&&o.enable(13),E.dithering&&o.enable(14),E.transmission&&o.enable(15),E.sheen&&o.enable(16),E.opaque&&o.enable(17),E.pointsUvs&&o.enable(18),E.decodeVideoTexture&&o.enable(19),E.decodeVideoTextureEmissive&&o.enable(20),E.alphaToCoverage&&o.enable(21),E.numLightProbeGrids>0&&o.enable(22),E.hasPositionAttribute&&o.enable(23),_.push(o.mask)}function S(_){let E=d[_.type],k;if(E){let L=Xn[E];k=yf.clone(L.uniforms)}else k=_.uniforms;return k}function w(_,E){let k=h.get(E);return k!==void 0?++k.usedTimes:(k=new Rv(i,E,_,s),c.push(k),h.set(E,k)),k}function b(_){if(--_.usedTimes===0){let E=c.indexOf(_);c[E]=c[c.length-1],c.pop(),h.delete(_.cacheKey),_.destroy()}}function R(_){a.remove(_)}function A(){a.dispose()}return{getParameters:m,getProgramCacheKey:x,getUniforms:S,acquireProgram:w,releaseProgram:b,releaseShaderCache:R,programs:c,dispose:A}}function Lv(){let i=new WeakMap;function t(o){return i.has(o)}function e(o){let a=i.get(o);return a===void 0&&(a={},i.set(o,a)),a}function n(o){i.delete(o)}function s(o,a,l){i.get(o)[a]=l}function r(){i=new WeakMap}return{has:t,get:e,remove:n,update:s,dispose:r}}function Dv(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.material.id!==t.material.id?i.material.id-t.material.id:i.materialVariant!==t.materialVariant?i.materialVariant-t.materialVariant:i.z!==t.z?i.z-t.z:i.id-t.id}function kf(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.z!==t.z?t.z-i.z:i.id-t.id}function zf(){let i=[],t=0,e=[],n=[],s=[];function r(){t=0,e.length=0,n.length=0,s.length=0}function o(d){let f=0;return d.isInstancedMesh&&(f+=2),d.isSkinnedMesh&&(f+=1),f}function a(d,f,m,x,p,g){let S=i[t];return S===void 0?(S={id:d.id,object:d,geometry:f,material:m,materialVariant:o(d),groupOrder:x,renderOrder:d.renderOrder,z:p,group:g},i[t]=S):(S.id=d.id,S.object=d,S.geometry=f,S.material=m,S.materialVariant=o(d),S.groupOrder=x,S.renderOrder=d.renderOrder,S.z=p,S.group=g),t++,S}function l(d,f,m,x,p,g,S){S.reversedDepth===!0&&(p=-p);let w=a(d,f,m,x,p,g);m.transmission>0?n.push(w):m.transparent===!0?s.push(w):e.push(w)}function c(d,f,m,x,p,g){let S=a(d,f,m,x,p,g);m.transmission>0?n.unshift(S):m.transparent===!0?s.unshift(S):e.unshift(S)}function h(d,f){e.length>1&&e.sort(d||Dv),n.length>1&&n.sort(f||kf),s.length>1&&s.sort(f||kf)}function u(){for(let d=t,f=i.length;d<f;d++){let m=i[d];if(m.id===null)break;m.id=null,m.object=null,m.geometry=null,m.material=null,m.group=null}}return{opaque:e,transmissive:n,transparent:s,init:r,push:l,unshift:c,finish:u,sort:h}}function Nv(){let i=new WeakMap;function t(n,s){let r=i.get(n),o;return r===void 0?(o=new zf,i.set(n,[o])):s>=r.length?(o=new zf,r.push(o)):o=r[s],o}function e(){i=new WeakMap}return{get:t,dispose:e}}function Ov(){let i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={direction:new N,color:new Ut};break;case"SpotLight":e={position:new N,direction:new N,color:new Ut,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new N,color:new Ut,distance:0,decay:0};break;case"HemisphereLight":e={direction:new N,skyColor:new Ut,groundColor:new Ut};break;case"RectAreaLight":e={color:new Ut,position:new N,halfWidth:new N,halfHeight:new N};break}return i[t.id]=e,e}}}function Uv(){let i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new It};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new It};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new It,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[t.id]=e,e}}}var Fv=0;function Bv(i,t){return(t.castShadow?2:0)-(i.castShadow?2:0)+(t.map?1:0)-(i.map?1:0)}function kv(i){let t=new Ov,e=Uv(),n={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new N);let s=new N,r=new Qt,o=new Qt;function a(c){let h=0,u=0,d=0;for(let V=0;V<9;V++)n.probe[V].set(0,0,0);let f=0,m=0,x=0,p=0,g=0,S=0,w=0,b=0,R=0,A=0,_=0,E=0,k=0,L=0;c.sort(Bv);for(let V=0,Y=c.length;V<Y;V++){let I=c[V],q=I.color,j=I.intensity,H=I.distance,st=null;if(I.shadow&&I.shadow.map&&(I.shadow.map.texture.format===Ci?st=I.shadow.map.texture:st=I.shadow.map.depthTexture||I.shadow.map.texture),I.isAmbientLight)h+=q.r*j,u+=q.g*j,d+=q.b*j;else if(I.isLightProbe){for(let X=0;X<9;X++)n.probe[X].addScaledVector(I.sh.coefficients[X],j);L++}else if(I.isSunLight){let X=t.get(I);if(X.color.copy(I.color).multiplyScalar(I.intensity),I.castShadow){let tt=I.shadow,et=e.get(I);et.shadowIntensity=tt.intensity,et.shadowBias=tt.bias,et.shadowNormalBias=tt.normalBias,et.shadowRadius=tt.radius,et.shadowMapSize.copy(tt.mapSize).multiply(tt.getFrameExtents()),n.sunShadow[m]=et,n.sunShadowMap[m]=st;let wt=tt.getViewportCount();for(let Bt=0;Bt<wt;Bt++)n.sunShadowMatrix[x+Bt]=tt.getMatrix(Bt),n.sunShadowCascade[x+Bt]=tt._cascadeData[Bt];x+=wt,m++}n.sun[f]=X,f++}else if(I.isDirectionalLight){let X=t.get(I);if(X.color.copy(I.color).multiplyScalar(I.intensity),I.castShadow){let tt=I.shadow,et=e.get(I);et.shadowIntensity=tt.intensity,et.shadowBias=tt.bias,et.shadowNormalBias=tt.normalBias,et.shadowRadius=tt.radius,et.shadowMapSize=tt.mapSize,n.directionalShadow[p]=et,n.directionalShadowMap[p]=st,n.directionalShadowMatrix[p]=I.shadow.matrix,R++}n.directional[p]=X,p++}else if(I.isSpotLight){let X=t.get(I);X.position.setFromMatrixPosition(I.matrixWorld),X.color.copy(q).multiplyScalar(j),X.distance=H,X.coneCos=Math.cos(I.angle),X.penumbraCos=Math.cos(I.angle*(1-I.penumbra)),X.decay=I.decay,n.spot[S]=X;let tt=I.shadow;if(I.map&&(n.spotLightMap[E]=I.map,E++,tt.updateMatrices(I),I.castShadow&&k++),n.spotLightMatrix[S]=tt.matrix,I.castShadow){let et=e.get(I);et.shadowIntensity=tt.intensity,et.shadowBias=tt.bias,et.shadowNormalBias=tt.normalBias,et.shadowRadius=tt.radius,et.shadowMapSize=tt.mapSize,n.spotShadow[S]=et,n.spotShadowMap[S]=st,_++}S++}else if(I.isRectAreaLight){let X=t.get(I);X.color.copy(q).multiplyScalar(j),X.halfWidth.set(I.width*.5,0,0),X.halfHeight.set(0,I.height*.5,0),n.rectArea[w]=X,w++}else if(I.isPointLight){let X=t.get(I);if(X.color.copy(I.color).multiplyScalar(I.intensity),X.distance=I.distance,X.decay=I.decay,I.castShadow){let tt=I.shadow,et=e.get(I);et.shadowIntensity=tt.intensity,et.shadowBias=tt.bias,et.shadowNormalBias=tt.normalBias,et.shadowRadius=tt.radius,et.shadowMapSize=tt.mapSize,et.shadowCameraNear=tt.camera.near,et.shadowCameraFar=tt.camera.far,n.pointShadow[g]=et,n.pointShadowMap[g]=st,n.pointShadowMatrix[g]=I.shadow.matrix,A++}n.point[g]=X,g++}else if(I.isHemisphereLight){let X=t.get(I);X.skyColor.copy(I.color).multiplyScalar(j),X.groundColor.copy(I.groundColor).multiplyScalar(j),n.hemi[b]=X,b++}}w>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=gt.LTC_FLOAT_1,n.rectAreaLTC2=gt.LTC_FLOAT_2):(n.rectAreaLTC1=gt.LTC_HALF_1,n.rectAreaLTC2=gt.LTC_HALF_2)),n.ambient[0]=h,n.ambient[1]=u,n.ambient[2]=d;let O=n.hash;(O.sunLength!==f||O.directionalLength!==p||O.pointLength!==g||O.spotLength!==S||O.rectAreaLength!==w||O.hemiLength!==b||O.numSunShadows!==m||O.numDirectionalShadows!==R||O.numPointShadows!==A||O.numSpotShadows!==_||O.numSpotMaps!==E||O.numLightProbes!==L)&&(n.sun.length=f,n.directional.length=p,n.spot.length=S,n.rectArea.length=w,n.point.length=g,n.hemi.length=b,n.sunShadow.length=m,n.sunShadowMap.length=m,n.sunShadowMatrix.length=x,n.sunShadowCascade.length=x,n.directionalShadow.length=R,n.directionalShadowMap.length=R,n.directionalShadowMatrix.length=R,n.pointShadow.length=A,n.pointShadowMap.length=A,n.pointShadowMatrix.length=A,n.spotShadow.length=_,n.spotShadowMap.length=_,n.spotLightMatrix.length=_+E-k,n.spotLightMap.length=E,n.numSpotLightShadowsWithMaps=k,n.numLightProbes=L,O.sunLength=f,O.directionalLength=p,O.pointLength=g,O.spotLength=S,O.rectAreaLength=w,O.hemiLength=b,O.numSunShadows=m,O.numDirectionalShadows=R,O.numPointShadows=A,O.numSpotShadows=_,O.numSpotMaps=E,O.numLightProbes=L,n.version=Fv++)}function l(c,h){let u=0,d=0,f=0,m=0,x=0,p=0,g=h.matrixWorldInverse;for(let S=0,w=c.length;S<w;S++){let b=c[S];if(b.isSunLight){let R=n.sun[u];R.direction.setFromMatrixPosition(b.matrixWorld),R.direction.transformDirection(g),u++}else if(b.isDirectionalLight){let R=n.directional[d];R.direction.setFromMatrixPosition(b.matrixWorld),s.setFromMatrixPosition(b.target.matrixWorld),R.direction.sub(s),R.direction.transformDirection(g),d++}else if(b.isSpotLight){let R=n.spot[m];R.position.setFromMatrixPosition(b.matrixWorld),R.position.applyMatrix4(g),R.direction.setFromMatrixPosition(b.matrixWorld),s.setFromMatrixPosition(b.target.matrixWorld),R.direction.sub(s),R.direction.transformDirection(g),m++}else if(b.isRectAreaLight){let R=n.rectArea[x];R.position.setFromMatrixPosition(b.matrixWorld),R.position.applyMatrix4(g),o.identity(),r.copy(b.matrixWorld),r.premultiply(g),o.extractRotation(r),R.halfWidth.set(b.width*.5,0,0),R.halfHeight.set(0,b.height*.5,0),R.halfWidth.applyMatrix4(o),R.halfHeight.applyMatrix4(o),x++}else if(b.isPointLight){let R=n.point[f];R.position.setFromMatrixPosition(b.matrixWorld),R.position.applyMatrix4(g),f++}else if(b.isHemisphereLight){let R=n.hemi[p];R.direction.setFromMatrixPosition(b.matrixWorld),R.direction.transformDirection(g),p++}}}return{setup:a,setupView:l,state:n}}function Vf(i){let t=new kv(i),e=[],n=[],s=[];function r(u){h.camera=u,e.length=0,n.length=0,s.length=0}function o(u){u.isLightProbeGrid?s.push(u):e.push(u)}function a(u){n.push(u)}function l(){t.setup(e),s.sort((u,d)=>u.priority-d.priority||u.id-d.id)}function c(u){t.setupView(e,u)}let h={lightsArray:e,shadowsArray:n,lightProbeGridArray:s,camera:null,lights:t,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function zv(i){let t=new WeakMap;function e(s,r=0){let o=t.get(s),a;return o===void 0?(a=new Vf(i),t.set(s,[a])):r>=o.length?(a=new Vf(i),o.push(a)):a=o[r],a}function n(){t=new WeakMap}return{get:e,dispose:n}}var Vv=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,Gv=`uniform sampler2D shadow_pass;
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
}`,Hv=[new N(1,0,0),new N(-1,0,0),new N(0,1,0),new N(0,-1,0),new N(0,0,1),new N(0,0,-1)],Wv=[new N(0,-1,0),new N(0,-1,0),new N(0,0,1),new N(0,0,-1),new N(0,-1,0),new N(0,-1,0)],Gf=new Qt,Cr=new N,wh=new N;function Xv(i,t,e){let n=new Vi,s=new It,r=new It,o=new ge,a=new qo,l=new $o,c={},h=e.maxTextureSize,u={[Gn]:Ze,[Ze]:Gn,[fn]:fn},d=new zn({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new It},radius:{value:4}},vertexShader:Vv,fragmentShader:Gv}),f=d.clone();f.defines.HORIZONTAL_PASS=1;let m=new Ye;m.setAttribute("position",new ye(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let x=new tn(m,d),p=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Mr;let g=this.type;this.render=function(A,_,E){if(p.enabled===!1||p.autoUpdate===!1&&p.needsUpdate===!1||A.length===0)return;this.type===Pd&&(Lt("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=Mr);let k=i.getRenderTarget(),L=i.getActiveCubeFace(),O=i.getActiveMipmapLevel(),V=i.state;V.setBlending(Hi),V.buffers.depth.getReversed()===!0?V.buffers.color.setClear(0,0,0,0):V.buffers.color.setClear(1,1,1,1),V.buffers.depth.setTest(!0),V.setScissorTest(!1);let Y=g!==this.type;Y&&_.traverse(function(I){I.material&&(Array.isArray(I.material)?I.material.forEach(q=>q.needsUpdate=!0):I.material.needsUpdate=!0)});for(let I=0,q=A.length;I<q;I++){let j=A[I],H=j.shadow;if(H===void 0){Lt("WebGLShadowMap:",j,"has no shadow.");continue}if(H.autoUpdate===!1&&H.needsUpdate===!1)continue;s.copy(H.mapSize);let st=H.getFrameExtents();s.multiply(st),r.copy(H.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/st.x),s.x=r.x*st.x,H.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/st.y),s.y=r.y*st.y,H.mapSize.y=r.y));let X=i.state.buffers.depth.getReversed();if(H.camera._reversedDepth=X,H.map===null||Y===!0){if(H.map!==null&&(H.map.depthTexture!==null&&(H.map.depthTexture.dispose(),H.map.depthTexture=null),H.map.dispose()),this.type===Ss){if(j.isPointLight){Lt("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}H.map=new cn(s.x,s.y,{format:Ci,type:Pn,minFilter:$e,magFilter:$e,generateMipmaps:!1}),H.map.texture.name=j.name+".shadowMap",H.map.depthTexture=new ii(s.x,s.y,pn),H.map.depthTexture.name=j.name+".shadowMapDepth",H.map.depthTexture.format=ni,H.map.depthTexture.compareFunction=null,H.map.depthTexture.minFilter=_e,H.map.depthTexture.magFilter=_e}else j.isPointLight?(H.map=new Ir(s.x),H.map.depthTexture=new hr(s.x,Cn)):(H.map=new cn(s.x,s.y),H.map.depthTexture=new ii(s.x,s.y,Cn)),H.map.depthTexture.name=j.name+".shadowMap",H.map.depthTexture.format=ni,this.type===Mr?(H.map.depthTexture.compareFunction=X?dh:uh,H.map.depthTexture.minFilter=$e,H.map.depthTexture.magFilter=$e):(H.map.depthTexture.compareFunction=null,H.map.depthTexture.minFilter=_e,H.map.depthTexture.magFilter=_e);H.camera.updateProjectionMatrix()}H.map.isWebGLCubeRenderTarget!==!0&&(H.map.width!==s.x||H.map.height!==s.y)&&H.map.setSize(s.x,s.y);let tt=H.map.isWebGLCubeRenderTarget?6:H.getViewportCount();j.isPointLight!==!0&&H.updateMatrices(j,E);let et=(H.camera.layers.mask&4294967294)!==0?H.camera.layers:E.layers;for(let wt=0;wt<tt;wt++){let Bt=H.getCamera(wt);if(j.isPointLight){let J=H.camera,_t=H.matrix,Mt=j.distance||J.far;Mt!==J.far&&(J.far=Mt,J.updateProjectionMatrix()),Cr.setFromMatrixPosition(j.matrixWorld),J.position.copy(Cr),wh.copy(J.position),wh.add(Hv[wt]),J.up.copy(Wv[wt]),J.lookAt(wh),J.updateMatrixWorld(),_t.makeTranslation(-Cr.x,-Cr.y,-Cr.z),Gf.multiplyMatrices(J.projectionMatrix,J.matrixWorldInverse),H._frustum.setFromProjectionMatrix(Gf,J.coordinateSystem,J.reversedDepth)}if(H.map.isWebGLCubeRenderTarget)i.setRenderTarget(H.map,wt),i.clear();else{wt===0&&(i.setRenderTarget(H.map),i.clear());let J=H.getViewport(wt);o.set(r.x*J.x,r.y*J.y,r.x*J.z,r.y*J.w),V.viewport(o)}n=H.getFrustum(wt),b(_,E,Bt,j,et,this.type)}H.isPointLightShadow!==!0&&this.type===Ss&&S(H,E),H.needsUpdate=!1}g=this.type,p.needsUpdate=!1,i.setRenderTarget(k,L,O)};function S(A,_){let E=t.update(x);d.defines.VSM_SAMPLES!==A.blurSamples&&(d.defines.VSM_SAMPLES=A.blurSamples,f.defines.VSM_SAMPLES=A.blurSamples,d.needsUpdate=!0,f.needsUpdate=!0),A.mapPass===null?A.mapPass=new cn(s.x,s.y,{format:Ci,type:Pn}):(A.mapPass.width!==A.map.width||A.mapPass.height!==A.map.height)&&A.mapPass.setSize(A.map.width,A.map.height),d.uniforms.shadow_pass.value=A.map.depthTexture,d.uniforms.resolution.value.set(A.map.width,A.map.height),d.uniforms.radius.value=A.radius,i.setRenderTarget(A.mapPass),i.clear(),i.renderBufferDirect(_,null,E,d,x,null),f.uniforms.shadow_pass.value=A.mapPass.texture,f.uniforms.resolution.value.set(A.map.width,A.map.height),f.uniforms.radius.value=A.radius,i.setRenderTarget(A.map),i.clear(),i.renderBufferDirect(_,null,E,f,x,null)}function w(A,_,E,k){let L=null,O=E.isPointLight===!0?A.customDistanceMaterial:A.customDepthMaterial;if(O!==void 0)L=O;else if(L=E.isPointLight===!0?l:a,i.localClippingEnabled&&_.clipShadows===!0&&Array.isArray(_.clippingPlanes)&&_.clippingPlanes.length!==0||_.displacementMap&&_.displacementScale!==0||_.alphaMap&&_.alphaTest>0||_.map&&_.alphaTest>0||_.alphaToCoverage===!0){let V=L.uuid,Y=_.uuid,I=c[V];I===void 0&&(I={},c[V]=I);let q=I[Y];q===void 0&&(q=L.clone(),I[Y]=q,_.addEventListener("dispose",R)),L=q}if(L.visible=_.visible,L.wireframe=_.wireframe,k===Ss?L.side=_.shadowSide!==null?_.shadowSide:_.side:L.side=_.shadowSide!==null?_.shadowSide:u[_.side],L.alphaMap=_.alphaMap,L.alphaTest=_.alphaToCoverage===!0?.5:_.alphaTest,L.map=_.map,L.clipShadows=_.clipShadows,L.clippingPlanes=_.clippingPlanes,L.clipIntersection=_.clipIntersection,L.displacementMap=_.displacementMap,L.displacementScale=_.displacementScale,L.displacementBias=_.displacementBias,L.wireframeLinewidth=_.wireframeLinewidth,L.linewidth=_.linewidth,E.isPointLight===!0&&L.isMeshDistanceMaterial===!0){let V=i.properties.get(L);V.light=E}return L}function b(A,_,E,k,L,O){if(A.visible===!1)return;if(A.layers.test(L)&&(A.isMesh||A.isLine||A.isPoints)&&(A.castShadow||A.receiveShadow&&O===Ss)&&(!A.frustumCulled||A.intersectsFrustum(n))){A.modelViewMatrix.multiplyMatrices(E.matrixWorldInverse,A.matrixWorld);let I=t.update(A),q=A.material;if(Array.isArray(q)){let j=I.groups;for(let H=0,st=j.length;H<st;H++){let X=j[H],tt=q[X.materialIndex];if(tt&&tt.visible){let et=w(A,tt,k,O);A.onBeforeShadow(i,A,_,E,I,et,X),i.renderBufferDirect(E,null,I,et,A,X),A.onAfterShadow(i,A,_,E,I,et,X)}}}else if(q.visible){let j=w(A,q,k,O);A.onBeforeShadow(i,A,_,E,I,j,null),i.renderBufferDirect(E,null,I,j,A,null),A.onAfterShadow(i,A,_,E,I,j,null)}}let Y=A.children;for(let I=0,q=Y.length;I<q;I++)b(Y[I],_,E,k,L,O)}function R(A){A.target.removeEventListener("dispose",R);for(let E in c){let k=c[E],L=A.target.uuid;L in k&&(k[L].dispose(),delete k[L])}}}function qv(i,t){function e(){let C=!1,K=new ge,W=null,ht=new ge(0,0,0,0);return{setMask:function(ot){W!==ot&&!C&&(i.colorMask(ot,ot,ot,ot),W=ot)},setLocked:function(ot){C=ot},setClear:function(ot,lt,At,Wt,rt){rt===!0&&(ot*=Wt,lt*=Wt,At*=Wt),K.set(ot,lt,At,Wt),ht.equals(K)===!1&&(i.clearColor(ot,lt,At,Wt),ht.copy(K))},reset:function(){C=!1,W=null,ht.set(-1,0,0,0)}}}function n(){let C=!1,K=!1,W=null,ht=null,ot=null;return{setReversed:function(lt){if(K!==lt){let At=t.get("EXT_clip_control");lt?At.clipControlEXT(At.LOWER_LEFT_EXT,At.ZERO_TO_ONE_EXT):At.clipControlEXT(At.LOWER_LEFT_EXT,At.NEGATIVE_ONE_TO_ONE_EXT),K=lt;let Wt=ot;ot=null,this.setClear(Wt)}},getReversed:function(){return K},setTest:function(lt){lt?xt(i.DEPTH_TEST):Vt(i.DEPTH_TEST)},setMask:function(lt){W!==lt&&!C&&(i.depthMask(lt),W=lt)},setFunc:function(lt){if(K&&(lt=uf[lt]),ht!==lt){switch(lt){case Po:i.depthFunc(i.NEVER);break;case Io:i.depthFunc(i.ALWAYS);break;case Lo:i.depthFunc(i.LESS);break;case fs:i.depthFunc(i.LEQUAL);break;case Do:i.depthFunc(i.EQUAL);break;case No:i.depthFunc(i.GEQUAL);break;case Oo:i.depthFunc(i.GREATER);break;case Uo:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}ht=lt}},setLocked:function(lt){C=lt},setClear:function(lt){ot!==lt&&(ot=lt,K&&(lt=1-lt),i.clearDepth(lt))},reset:function(){C=!1,W=null,ht=null,ot=null,K=!1}}}function s(){let C=!1,K=null,W=null,ht=null,ot=null,lt=null,At=null,Wt=null,rt=null;return{setTest:function(Rt){C||(Rt?xt(i.STENCIL_TEST):Vt(i.STENCIL_TEST))},setMask:function(Rt){K!==Rt&&!C&&(i.stencilMask(Rt),K=Rt)},setFunc:function(Rt,Ht,mt){(W!==Rt||ht!==Ht||ot!==mt)&&(i.stencilFunc(Rt,Ht,mt),W=Rt,ht=Ht,ot=mt)},setOp:function(Rt,Ht,mt){(lt!==Rt||At!==Ht||Wt!==mt)&&(i.stencilOp(Rt,Ht,mt),lt=Rt,At=Ht,Wt=mt)},setLocked:function(Rt){C=Rt},setClear:function(Rt){rt!==Rt&&(i.clearStencil(Rt),rt=Rt)},reset:function(){C=!1,K=null,W=null,ht=null,ot=null,lt=null,At=null,Wt=null,rt=null}}}let r=new e,o=new n,a=new s,l={},c=new WeakMap,h={},u={},d={},f=new WeakMap,m=[],x=null,p=!1,g=null,S=null,w=null,b=null,R=null,A=null,_=null,E=new Ut(0,0,0),k=0,L=!1,O=null,V=null,Y=null,I=null,q=null,j=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS),H=!1,st=0,X=i.getParameter(i.VERSION);X.indexOf("WebGL")!==-1?(st=parseFloat(/^WebGL (\d)/.exec(X)[1]),H=st>=1):X.indexOf("OpenGL ES")!==-1&&(st=parseFloat(/^OpenGL ES (\d)/.exec(X)[1]),H=st>=2);let tt=null,et={},wt=i.getParameter(i.SCISSOR_BOX),Bt=i.getParameter(i.VIEWPORT),J=new ge().fromArray(wt),_t=new ge().fromArray(Bt);function Mt(C,K,W,ht){let ot=new Uint8Array(4),lt=i.createTexture();i.bindTexture(C,lt),i.texParameteri(C,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(C,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let At=0;At<W;At++)C===i.TEXTURE_3D||C===i.TEXTURE_2D_ARRAY?i.texImage3D(K,0,i.RGBA,1,1,ht,0,i.RGBA,i.UNSIGNED_BYTE,ot):i.texImage2D(K+At,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,ot);return lt}let Ct={};Ct[i.TEXTURE_2D]=Mt(i.TEXTURE_2D,i.TEXTURE_2D,1),Ct[i.TEXTURE_CUBE_MAP]=Mt(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),Ct[i.TEXTURE_2D_ARRAY]=Mt(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),Ct[i.TEXTURE_3D]=Mt(i.TEXTURE_3D,i.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),xt(i.DEPTH_TEST),o.setFunc(fs),je(!1),fe(Gc),xt(i.CULL_FACE),Oe(Hi);function xt(C){h[C]!==!0&&(i.enable(C),h[C]=!0)}function Vt(C){h[C]!==!1&&(i.disable(C),h[C]=!1)}function be(C,K){return d[C]!==K?(i.bindFramebuffer(C,K),d[C]=K,C===i.DRAW_FRAMEBUFFER&&(d[i.FRAMEBUFFER]=K),C===i.FRAMEBUFFER&&(d[i.DRAW_FRAMEBUFFER]=K),!0):!1}function Dt(C,K){let W=m,ht=!1;if(C){W=f.get(K),W===void 0&&(W=[],f.set(K,W));let ot=C.textures;if(W.length!==ot.length||W[0]!==i.COLOR_ATTACHMENT0){for(let lt=0,At=ot.length;lt<At;lt++)W[lt]=i.COLOR_ATTACHMENT0+lt;W.length=ot.length,ht=!0}}else W[0]!==i.BACK&&(W[0]=i.BACK,ht=!0);ht&&i.drawBuffers(W)}function se(C){return x!==C?(i.useProgram(C),x=C,!0):!1}let oe={[Wi]:i.FUNC_ADD,[Ld]:i.FUNC_SUBTRACT,[Dd]:i.FUNC_REVERSE_SUBTRACT};oe[Nd]=i.MIN,oe[Od]=i.MAX;let Yt={[Ud]:i.ZERO,[Fd]:i.ONE,[Bd]:i.SRC_COLOR,[qc]:i.SRC_ALPHA,[Wd]:i.SRC_ALPHA_SATURATE,[Gd]:i.DST_COLOR,[zd]:i.DST_ALPHA,[kd]:i.ONE_MINUS_SRC_COLOR,[$c]:i.ONE_MINUS_SRC_ALPHA,[Hd]:i.ONE_MINUS_DST_COLOR,[Vd]:i.ONE_MINUS_DST_ALPHA,[Xd]:i.CONSTANT_COLOR,[qd]:i.ONE_MINUS_CONSTANT_COLOR,[$d]:i.CONSTANT_ALPHA,[Yd]:i.ONE_MINUS_CONSTANT_ALPHA};function Oe(C,K,W,ht,ot,lt,At,Wt,rt,Rt){if(C===Hi){p===!0&&(Vt(i.BLEND),p=!1);return}if(p===!1&&(xt(i.BLEND),p=!0),C!==Id){if(C!==g||Rt!==L){if((S!==Wi||R!==Wi)&&(i.blendEquation(i.FUNC_ADD),S=Wi,R=Wi),Rt)switch(C){case ws:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Hc:i.blendFunc(i.ONE,i.ONE);break;case Wc:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case Xc:i.blendFuncSeparate(i.DST_COLOR,i.ONE_MINUS_SRC_ALPHA,i.ZERO,i.ONE);break;default:Nt("WebGLState: Invalid blending: ",C);break}else switch(C){case ws:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Hc:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE,i.ONE,i.ONE);break;case Wc:Nt("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case Xc:Nt("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:Nt("WebGLState: Invalid blending: ",C);break}w=null,b=null,A=null,_=null,E.set(0,0,0),k=0,g=C,L=Rt}return}ot=ot||K,lt=lt||W,At=At||ht,(K!==S||ot!==R)&&(i.blendEquationSeparate(oe[K],oe[ot]),S=K,R=ot),(W!==w||ht!==b||lt!==A||At!==_)&&(i.blendFuncSeparate(Yt[W],Yt[ht],Yt[lt],Yt[At]),w=W,b=ht,A=lt,_=At),(Wt.equals(E)===!1||rt!==k)&&(i.blendColor(Wt.r,Wt.g,Wt.b,rt),E.copy(Wt),k=rt),g=C,L=!1}function Ee(C,K){C.side===fn?Vt(i.CULL_FACE):xt(i.CULL_FACE);let W=C.side===Ze;K&&(W=!W),je(W),C.blending===ws&&C.transparent===!1?Oe(Hi):Oe(C.blending,C.blendEquation,C.blendSrc,C.blendDst,C.blendEquationAlpha,C.blendSrcAlpha,C.blendDstAlpha,C.blendColor,C.blendAlpha,C.premultipliedAlpha),o.setFunc(C.depthFunc),o.setTest(C.depthTest),o.setMask(C.depthWrite),r.setMask(C.colorWrite);let ht=C.stencilWrite;a.setTest(ht),ht&&(a.setMask(C.stencilWriteMask),a.setFunc(C.stencilFunc,C.stencilRef,C.stencilFuncMask),a.setOp(C.stencilFail,C.stencilZFail,C.stencilZPass)),Pe(C.polygonOffset,C.polygonOffsetFactor,C.polygonOffsetUnits),C.alphaToCoverage===!0?xt(i.SAMPLE_ALPHA_TO_COVERAGE):Vt(i.SAMPLE_ALPHA_TO_COVERAGE)}function je(C){O!==C&&(C?i.frontFace(i.CW):i.frontFace(i.CCW),O=C)}function fe(C){C!==Rd?(xt(i.CULL_FACE),C!==V&&(C===Gc?i.cullFace(i.BACK):C===Cd?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):Vt(i.CULL_FACE),V=C}function On(C){C!==Y&&(H&&i.lineWidth(C),Y=C)}function Pe(C,K,W){C?(xt(i.POLYGON_OFFSET_FILL),(I!==K||q!==W)&&(I=K,q=W,o.getReversed()&&(K=-K,W=-W),i.polygonOffset(K,W))):Vt(i.POLYGON_OFFSET_FILL)}function gn(C){C?xt(i.SCISSOR_TEST):Vt(i.SCISSOR_TEST)}function _n(C){C===void 0&&(C=i.TEXTURE0+j-1),tt!==C&&(i.activeTexture(C),tt=C)}function xn(C,K,W){W===void 0&&(tt===null?W=i.TEXTURE0+j-1:W=tt);let ht=et[W];ht===void 0&&(ht={type:void 0,texture:void 0},et[W]=ht),(ht.type!==C||ht.texture!==K)&&(tt!==W&&(i.activeTexture(W),tt=W),i.bindTexture(C,K||Ct[C]),ht.type=C,ht.texture=K)}function D(){let C=et[tt];C!==void 0&&C.type!==void 0&&(i.bindTexture(C.type,null),C.type=void 0,C.texture=void 0)}function yn(){try{i.compressedTexImage2D(...arguments)}catch(C){Nt("WebGLState:",C)}}function ue(){try{i.compressedTexImage3D(...arguments)}catch(C){Nt("WebGLState:",C)}}function de(){try{i.texSubImage2D(...arguments)}catch(C){Nt("WebGLState:",C)}}function pt(){try{i.texSubImage3D(...arguments)}catch(C){Nt("WebGLState:",C)}}function Te(){try{i.compressedTexSubImage2D(...arguments)}catch(C){Nt("WebGLState:",C)}}function Pt(){try{i.compressedTexSubImage3D(...arguments)}catch(C){Nt("WebGLState:",C)}}function Ft(){try{i.texStorage2D(...arguments)}catch(C){Nt("WebGLState:",C)}}function T(){try{i.texStorage3D(...arguments)}catch(C){Nt("WebGLState:",C)}}function y(){try{i.texImage2D(...arguments)}catch(C){Nt("WebGLState:",C)}}function F(){try{i.texImage3D(...arguments)}catch(C){Nt("WebGLState:",C)}}function it(C){return u[C]!==void 0?u[C]:i.getParameter(C)}function Q(C,K){u[C]!==K&&(i.pixelStorei(C,K),u[C]=K)}function at(C){J.equals(C)===!1&&(i.scissor(C.x,C.y,C.z,C.w),J.copy(C))}function dt(C){_t.equals(C)===!1&&(i.viewport(C.x,C.y,C.z,C.w),_t.copy(C))}function $(C,K){let W=c.get(K);W===void 0&&(W=new WeakMap,c.set(K,W));let ht=W.get(C);ht===void 0&&(ht=i.getUniformBlockIndex(K,C.name),i.uniformBlockBinding(K,ht,ht),W.set(C,ht))}function Z(C,K,W){let ot=c.get(K).get(C);l[ot]!==W&&(i.bindBufferBase(i.UNIFORM_BUFFER,ot,W),l[ot]=W)}function ct(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),o.setReversed(!1),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),i.pixelStorei(i.PACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,!1),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,i.BROWSER_DEFAULT_WEBGL),i.pixelStorei(i.PACK_ROW_LENGTH,0),i.pixelStorei(i.PACK_SKIP_PIXELS,0),i.pixelStorei(i.PACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_ROW_LENGTH,0),i.pixelStorei(i.UNPACK_IMAGE_HEIGHT,0),i.pixelStorei(i.UNPACK_SKIP_PIXELS,0),i.pixelStorei(i.UNPACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_SKIP_IMAGES,0),h={},u={},tt=null,et={},d={},l={},f=new WeakMap,m=[],x=null,p=!1,g=null,S=null,w=null,b=null,R=null,A=null,_=null,E=new Ut(0,0,0),k=0,L=!1,O=null,V=null,Y=null,I=null,q=null,J.set(0,0,i.canvas.width,i.canvas.height),_t.set(0,0,i.canvas.width,i.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:xt,disable:Vt,bindFramebuffer:be,drawBuffers:Dt,useProgram:se,setBlending:Oe,setMaterial:Ee,setFlipSided:je,setCullFace:fe,setLineWidth:On,setPolygonOffset:Pe,setScissorTest:gn,activeTexture:_n,bindTexture:xn,unbindTexture:D,compressedTexImage2D:yn,compressedTexImage3D:ue,texImage2D:y,texImage3D:F,pixelStorei:Q,getParameter:it,updateUBOMapping:$,uniformBlockBinding:Z,texStorage2D:Ft,texStorage3D:T,texSubImage2D:de,texSubImage3D:pt,compressedTexSubImage2D:Te,compressedTexSubImage3D:Pt,scissor:at,viewport:dt,reset:ct}}function $v(i,t,e,n,s,r,o){let a=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new It,h=new WeakMap,u=new Set,d,f=new WeakMap,m=new Set,x=new FinalizationRegistry(T=>m.delete(T)),p=!1;try{p=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function g(T,y){return p?new OffscreenCanvas(T,y):ir("canvas")}function S(T,y,F){let it=1,Q=Ft(T);if((Q.width>F||Q.height>F)&&(it=F/Math.max(Q.width,Q.height)),it<1)if(typeof HTMLImageElement<"u"&&T instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&T instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&T instanceof ImageBitmap||typeof VideoFrame<"u"&&T instanceof VideoFrame){let at=Math.floor(it*Q.width),dt=Math.floor(it*Q.height);d===void 0&&(d=g(at,dt));let $=y?g(at,dt):d;return $.width=at,$.height=dt,$.getContext("2d").drawImage(T,0,0,at,dt),Lt("WebGLRenderer: Texture has been resized from ("+Q.width+"x"+Q.height+") to ("+at+"x"+dt+")."),$}else return"data"in T&&Lt("WebGLRenderer: Image in DataTexture is too big ("+Q.width+"x"+Q.height+")."),T;return T}function w(T){return T.generateMipmaps}function b(T){i.generateMipmap(T)}function R(T){return T.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:T.isWebGL3DRenderTarget?i.TEXTURE_3D:T.isWebGLArrayRenderTarget||T.isCompressedArrayTexture?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D}function A(T,y,F,it,Q,at=!1){if(T!==null){if(i[T]!==void 0)return i[T];Lt("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+T+"'")}let dt;it&&(dt=t.get("EXT_texture_norm16"),dt||Lt("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let $=y;if(y===i.RED&&(F===i.FLOAT&&($=i.R32F),F===i.HALF_FLOAT&&($=i.R16F),F===i.UNSIGNED_BYTE&&($=i.R8),F===i.UNSIGNED_SHORT&&dt&&($=dt.R16_EXT),F===i.SHORT&&dt&&($=dt.R16_SNORM_EXT)),y===i.RED_INTEGER&&(F===i.UNSIGNED_BYTE&&($=i.R8UI),F===i.UNSIGNED_SHORT&&($=i.R16UI),F===i.UNSIGNED_INT&&($=i.R32UI),F===i.BYTE&&($=i.R8I),F===i.SHORT&&($=i.R16I),F===i.INT&&($=i.R32I)),y===i.RG&&(F===i.FLOAT&&($=i.RG32F),F===i.HALF_FLOAT&&($=i.RG16F),F===i.UNSIGNED_BYTE&&($=i.RG8),F===i.UNSIGNED_SHORT&&dt&&($=dt.RG16_EXT),F===i.SHORT&&dt&&($=dt.RG16_SNORM_EXT)),y===i.RG_INTEGER&&(F===i.UNSIGNED_BYTE&&($=i.RG8UI),F===i.UNSIGNED_SHORT&&($=i.RG16UI),F===i.UNSIGNED_INT&&($=i.RG32UI),F===i.BYTE&&($=i.RG8I),F===i.SHORT&&($=i.RG16I),F===i.INT&&($=i.RG32I)),y===i.RGB_INTEGER&&(F===i.UNSIGNED_BYTE&&($=i.RGB8UI),F===i.UNSIGNED_SHORT&&($=i.RGB16UI),F===i.UNSIGNED_INT&&($=i.RGB32UI),F===i.BYTE&&($=i.RGB8I),F===i.SHORT&&($=i.RGB16I),F===i.INT&&($=i.RGB32I)),y===i.RGBA_INTEGER&&(F===i.UNSIGNED_BYTE&&($=i.RGBA8UI),F===i.UNSIGNED_SHORT&&($=i.RGBA16UI),F===i.UNSIGNED_INT&&($=i.RGBA32UI),F===i.BYTE&&($=i.RGBA8I),F===i.SHORT&&($=i.RGBA16I),F===i.INT&&($=i.RGBA32I)),y===i.RGB&&(F===i.UNSIGNED_SHORT&&dt&&($=dt.RGB16_EXT),F===i.SHORT&&dt&&($=dt.RGB16_SNORM_EXT),F===i.UNSIGNED_INT_5_9_9_9_REV&&($=i.RGB9_E5),F===i.UNSIGNED_INT_10F_11F_11F_REV&&($=i.R11F_G11F_B10F)),y===i.RGBA){let Z=at?er:Kt.getTransfer(Q);F===i.FLOAT&&($=i.RGBA32F),F===i.HALF_FLOAT&&($=i.RGBA16F),F===i.UNSIGNED_BYTE&&($=Z===ie?i.SRGB8_ALPHA8:i.RGBA8),F===i.UNSIGNED_SHORT&&dt&&($=dt.RGBA16_EXT),F===i.SHORT&&dt&&($=dt.RGBA16_SNORM_EXT),F===i.UNSIGNED_SHORT_4_4_4_4&&($=i.RGBA4),F===i.UNSIGNED_SHORT_5_5_5_1&&($=i.RGB5_A1)}return($===i.R16F||$===i.R32F||$===i.RG16F||$===i.RG32F||$===i.RGBA16F||$===i.RGBA32F)&&t.get("EXT_color_buffer_float"),$}function _(T,y){let F;return T?y===null||y===Cn||y===qi?F=i.DEPTH24_STENCIL8:y===pn?F=i.DEPTH32F_STENCIL8:y===Ts&&(F=i.DEPTH24_STENCIL8,Lt("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):y===null||y===Cn||y===qi?F=i.DEPTH_COMPONENT24:y===pn?F=i.DEPTH_COMPONENT32F:y===Ts&&(F=i.DEPTH_COMPONENT16),F}function E(T,y){return w(T)===!0||T.isFramebufferTexture&&T.minFilter!==_e&&T.minFilter!==$e?Math.log2(Math.max(y.width,y.height))+1:T.mipmaps.length>0?T.mipmaps.length:T.isCompressedTexture&&Array.isArray(T.image)?y.mipmaps.length:1}function k(T){let y=new WeakRef(T);n.get(T).__ref=y,m.add(y),x.register(T,y,y)}function L(T){let y=n.get(T).__ref;y!==void 0&&(m.delete(y),x.unregister(y))}function O(T){Y(T.target)}function V(T){I(T.target)}function Y(T){T.removeEventListener("dispose",O),L(T),j(T),T.isVideoTexture&&h.delete(T),T.isHTMLTexture&&u.delete(T)}function I(T){T.removeEventListener("dispose",V),L(T),st(T)}function q(){for(let T of m){let y=T.deref();y!==void 0&&(y.isRenderTarget===!0?I(y):Y(y))}m.clear(),u.clear()}function j(T){let y=n.get(T);if(y.__webglInit===void 0)return;let F=T.source,it=f.get(F);if(it){let Q=it[y.__cacheKey];Q.usedTimes--,Q.usedTimes===0&&H(T),Object.keys(it).length===0&&f.delete(F)}n.remove(T)}function H(T){let y=n.get(T);i.deleteTexture(y.__webglTexture);let F=T.source,it=f.get(F);delete it[y.__cacheKey],o.memory.textures--}function st(T){let y=n.get(T);y.__depthDisposeCallback&&y.__depthDisposeCallback();let F=T.depthTexture;if(F&&F.renderTarget===T&&Y(F),T.isWebGLCubeRenderTarget)for(let Q=0;Q<6;Q++){if(Array.isArray(y.__webglFramebuffer[Q]))for(let at=0;at<y.__webglFramebuffer[Q].length;at++)i.deleteFramebuffer(y.__webglFramebuffer[Q][at]);else i.deleteFramebuffer(y.__webglFramebuffer[Q]);y.__webglDepthbuffer&&i.deleteRenderbuffer(y.__webglDepthbuffer[Q])}else{if(Array.isArray(y.__webglFramebuffer))for(let Q=0;Q<y.__webglFramebuffer.length;Q++)i.deleteFramebuffer(y.__webglFramebuffer[Q]);else i.deleteFramebuffer(y.__webglFramebuffer);if(y.__webglDepthbuffer&&i.deleteRenderbuffer(y.__webglDepthbuffer),y.__webglMultisampledFramebuffer&&i.deleteFramebuffer(y.__webglMultisampledFramebuffer),y.__webglColorRenderbuffer)for(let Q=0;Q<y.__webglColorRenderbuffer.length;Q++)y.__webglColorRenderbuffer[Q]&&i.deleteRenderbuffer(y.__webglColorRenderbuffer[Q]);y.__webglDepthRenderbuffer&&i.deleteRenderbuffer(y.__webglDepthRenderbuffer)}let it=T.textures;for(let Q=0,at=it.length;Q<at;Q++){let dt=n.get(it[Q]);dt.__webglTexture&&(i.deleteTexture(dt.__webglTexture),o.memory.textures--),n.remove(it[Q])}n.remove(T)}let X=0;function tt(){X=0}function et(){return X}function wt(T){X=T}function Bt(){let T=X;return T>=s.maxTextures&&Lt("WebGLTextures: Trying to use "+(T+1)+" texture units while this GPU supports only "+s.maxTextures),X+=1,T}function J(T){let y=[];return y.push(T.wrapS),y.push(T.wrapT),y.push(T.wrapR||0),y.push(T.magFilter),y.push(T.minFilter),y.push(T.anisotropy),y.push(T.internalFormat),y.push(T.format),y.push(T.type),y.push(T.generateMipmaps),y.push(T.mipmapsAutoUpdate),y.push(T.premultiplyAlpha),y.push(T.flipY),y.push(T.unpackAlignment),y.push(T.colorSpace),y.join()}function _t(T,y){let F=n.get(T);if(T.isVideoTexture&&Te(T),T.isRenderTargetTexture===!1&&T.isExternalTexture!==!0&&T.version>0&&F.__version!==T.version){let it=T.image;if(it===null)Lt("WebGLRenderer: Texture marked for update but no image data found.");else if(it.complete===!1)Lt("WebGLRenderer: Texture marked for update but image is incomplete");else{Ee(F,T,y);return}}else T.isExternalTexture&&(F.__webglTexture=T.sourceTexture?T.sourceTexture:null);e.bindTexture(i.TEXTURE_2D,F.__webglTexture,i.TEXTURE0+y)}function Mt(T,y){let F=n.get(T);if(T.isRenderTargetTexture===!1&&T.version>0&&F.__version!==T.version){Ee(F,T,y);return}else T.isExternalTexture&&(F.__webglTexture=T.sourceTexture?T.sourceTexture:null);e.bindTexture(i.TEXTURE_2D_ARRAY,F.__webglTexture,i.TEXTURE0+y)}function Ct(T,y){let F=n.get(T);if(T.isRenderTargetTexture===!1&&T.version>0&&F.__version!==T.version){Ee(F,T,y);return}e.bindTexture(i.TEXTURE_3D,F.__webglTexture,i.TEXTURE0+y)}function xt(T,y){let F=n.get(T);if(T.version>0&&F.__version!==T.version){je(F,T,y);return}e.bindTexture(i.TEXTURE_CUBE_MAP,F.__webglTexture,i.TEXTURE0+y)}let Vt={[Fo]:i.REPEAT,[Fn]:i.CLAMP_TO_EDGE,[Bo]:i.MIRRORED_REPEAT},be={[_e]:i.NEAREST,[Kd]:i.NEAREST_MIPMAP_NEAREST,[br]:i.NEAREST_MIPMAP_LINEAR,[$e]:i.LINEAR,[la]:i.LINEAR_MIPMAP_NEAREST,[si]:i.LINEAR_MIPMAP_LINEAR},Dt={[ef]:i.NEVER,[fh]:i.ALWAYS,[nf]:i.LESS,[uh]:i.LEQUAL,[sf]:i.EQUAL,[dh]:i.GEQUAL,[rf]:i.GREATER,[of]:i.NOTEQUAL};function se(T,y){if(y.type===pn&&t.has("OES_texture_float_linear")===!1&&(y.magFilter===$e||y.magFilter===la||y.magFilter===br||y.magFilter===si||y.minFilter===$e||y.minFilter===la||y.minFilter===br||y.minFilter===si)&&Lt("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(T,i.TEXTURE_WRAP_S,Vt[y.wrapS]),i.texParameteri(T,i.TEXTURE_WRAP_T,Vt[y.wrapT]),(T===i.TEXTURE_3D||T===i.TEXTURE_2D_ARRAY)&&i.texParameteri(T,i.TEXTURE_WRAP_R,Vt[y.wrapR]),i.texParameteri(T,i.TEXTURE_MAG_FILTER,be[y.magFilter]),i.texParameteri(T,i.TEXTURE_MIN_FILTER,be[y.minFilter]),y.compareFunction&&(i.texParameteri(T,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(T,i.TEXTURE_COMPARE_FUNC,Dt[y.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(y.magFilter===_e||y.minFilter!==br&&y.minFilter!==si||y.type===pn&&t.has("OES_texture_float_linear")===!1)return;if(y.anisotropy>1||n.get(y).__currentAnisotropy){let F=t.get("EXT_texture_filter_anisotropic");i.texParameterf(T,F.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(y.anisotropy,s.getMaxAnisotropy())),n.get(y).__currentAnisotropy=y.anisotropy}}}function oe(T,y){let F=!1;T.__webglInit===void 0&&(T.__webglInit=!0,y.addEventListener("dispose",O),k(y));let it=y.source,Q=f.get(it);Q===void 0&&(Q={},f.set(it,Q));let at=J(y);if(at!==T.__cacheKey){Q[at]===void 0&&(Q[at]={texture:i.createTexture(),usedTimes:0},o.memory.textures++,F=!0),Q[at].usedTimes++;let dt=Q[T.__cacheKey];dt!==void 0&&(Q[T.__cacheKey].usedTimes--,dt.usedTimes===0&&H(y)),T.__cacheKey=at,T.__webglTexture=Q[at].texture}return F}function Yt(T,y,F){return Math.floor(Math.floor(T/F)/y)}function Oe(T,y,F,it){let at=T.updateRanges;if(at.length===0)e.texSubImage2D(i.TEXTURE_2D,0,0,0,y.width,y.height,F,it,y.data);else{at.sort((C,K)=>C.start-K.start);let dt=0;for(let C=1;C<at.length;C++){let K=at[dt],W=at[C],ht=K.start+K.count,ot=Yt(W.start,y.width,4),lt=Yt(K.start,y.width,4);W.start<=ht+1&&ot===lt&&Yt(W.start+W.count-1,y.width,4)===ot?K.count=Math.max(K.count,W.start+W.count-K.start):(++dt,at[dt]=W)}at.length=dt+1;let $=e.getParameter(i.UNPACK_ROW_LENGTH),Z=e.getParameter(i.UNPACK_SKIP_PIXELS),ct=e.getParameter(i.UNPACK_SKIP_ROWS);e.pixelStorei(i.UNPACK_ROW_LENGTH,y.width);for(let C=0,K=at.length;C<K;C++){let W=at[C],ht=Math.floor(W.start/4),ot=Math.ceil(W.count/4),lt=ht%y.width,At=Math.floor(ht/y.width),Wt=ot,rt=1;e.pixelStorei(i.UNPACK_SKIP_PIXELS,lt),e.pixelStorei(i.UNPACK_SKIP_ROWS,At),e.texSubImage2D(i.TEXTURE_2D,0,lt,At,Wt,rt,F,it,y.data)}T.clearUpdateRanges(),e.pixelStorei(i.UNPACK_ROW_LENGTH,$),e.pixelStorei(i.UNPACK_SKIP_PIXELS,Z),e.pixelStorei(i.UNPACK_SKIP_ROWS,ct)}}function Ee(T,y,F){let it=i.TEXTURE_2D;(y.isDataArrayTexture||y.isCompressedArrayTexture)&&(it=i.TEXTURE_2D_ARRAY),y.isData3DTexture&&(it=i.TEXTURE_3D);let Q=oe(T,y),at=y.source;e.bindTexture(it,T.__webglTexture,i.TEXTURE0+F);let dt=n.get(at);if(at.version!==dt.__version||Q===!0){if(e.activeTexture(i.TEXTURE0+F),(typeof ImageBitmap<"u"&&y.image instanceof ImageBitmap)===!1){let rt=Kt.getPrimaries(Kt.workingColorSpace),Rt=y.colorSpace===oi?null:Kt.getPrimaries(y.colorSpace),Ht=y.colorSpace===oi||rt===Rt?i.NONE:i.BROWSER_DEFAULT_WEBGL;e.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,y.flipY),e.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,y.premultiplyAlpha),e.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,Ht)}e.pixelStorei(i.UNPACK_ALIGNMENT,y.unpackAlignment);let Z=S(y.image,!1,s.maxTextureSize);Z=Pt(y,Z);let ct=r.convert(y.format,y.colorSpace),C=r.convert(y.type),K=A(y.internalFormat,ct,C,y.normalized,y.colorSpace,y.isVideoTexture);se(it,y);let W,ht=y.mipmaps,ot=y.isVideoTexture!==!0,lt=dt.__version===void 0||Q===!0,At=at.dataReady,Wt=E(y,Z);if(y.isDepthTexture)K=_(y.format===ri,y.type),lt&&(ot?e.texStorage2D(i.TEXTURE_2D,1,K,Z.width,Z.height):e.texImage2D(i.TEXTURE_2D,0,K,Z.width,Z.height,0,ct,C,null));else if(y.isDataTexture)if(ht.length>0){ot&&lt&&e.texStorage2D(i.TEXTURE_2D,Wt,K,ht[0].width,ht[0].height);for(let rt=0,Rt=ht.length;rt<Rt;rt++)W=ht[rt],ot?At&&e.texSubImage2D(i.TEXTURE_2D,rt,0,0,W.width,W.height,ct,C,W.data):e.texImage2D(i.TEXTURE_2D,rt,K,W.width,W.height,0,ct,C,W.data);y.generateMipmaps=!1}else ot?(lt&&e.texStorage2D(i.TEXTURE_2D,Wt,K,Z.width,Z.height),At&&Oe(y,Z,ct,C)):e.texImage2D(i.TEXTURE_2D,0,K,Z.width,Z.height,0,ct,C,Z.data);else if(y.isCompressedTexture)if(y.isCompressedArrayTexture){ot&&lt&&e.texStorage3D(i.TEXTURE_2D_ARRAY,Wt,K,ht[0].width,ht[0].height,Z.depth);for(let rt=0,Rt=ht.length;rt<Rt;rt++)if(W=ht[rt],y.format!==Ke)if(ct!==null)if(ot){if(At)if(y.layerUpdates.size>0){let Ht=bh(W.width,W.height,y.format,y.type);for(let mt of y.layerUpdates){let re=W.data.subarray(mt*Ht/W.data.BYTES_PER_ELEMENT,(mt+1)*Ht/W.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,rt,0,0,mt,W.width,W.height,1,ct,re)}}else e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,rt,0,0,0,W.width,W.height,Z.depth,ct,W.data)}else e.compressedTexImage3D(i.TEXTURE_2D_ARRAY,rt,K,W.width,W.height,Z.depth,0,W.data,0,0);else Lt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else ot?At&&e.texSubImage3D(i.TEXTURE_2D_ARRAY,rt,0,0,0,W.width,W.height,Z.depth,ct,C,W.data):e.texImage3D(i.TEXTURE_2D_ARRAY,rt,K,W.width,W.height,Z.depth,0,ct,C,W.data);y.layerUpdates.size>0&&y.clearLayerUpdates()}else{ot&&lt&&e.texStorage2D(i.TEXTURE_2D,Wt,K,ht[0].width,ht[0].height);for(let rt=0,Rt=ht.length;rt<Rt;rt++)W=ht[rt],y.format!==Ke?ct!==null?ot?At&&e.compressedTexSubImage2D(i.TEXTURE_2D,rt,0,0,W.width,W.height,ct,W.data):e.compressedTexImage2D(i.TEXTURE_2D,rt,K,W.width,W.height,0,W.data):Lt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):ot?At&&e.texSubImage2D(i.TEXTURE_2D,rt,0,0,W.width,W.height,ct,C,W.data):e.texImage2D(i.TEXTURE_2D,rt,K,W.width,W.height,0,ct,C,W.data)}else if(y.isDataArrayTexture)if(ot){if(lt&&e.texStorage3D(i.TEXTURE_2D_ARRAY,Wt,K,Z.width,Z.height,Z.depth),At)if(y.layerUpdates.size>0){let rt=bh(Z.width,Z.height,y.format,y.type);for(let Rt of y.layerUpdates){let Ht=Z.data.subarray(Rt*rt/Z.data.BYTES_PER_ELEMENT,(Rt+1)*rt/Z.data.BYTES_PER_ELEMENT);e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,Rt,Z.width,Z.height,1,ct,C,Ht)}y.clearLayerUpdates()}else e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,Z.width,Z.height,Z.depth,ct,C,Z.data)}else e.texImage3D(i.TEXTURE_2D_ARRAY,0,K,Z.width,Z.height,Z.depth,0,ct,C,Z.data);else if(y.isData3DTexture)ot?(lt&&e.texStorage3D(i.TEXTURE_3D,Wt,K,Z.width,Z.height,Z.depth),At&&e.texSubImage3D(i.TEXTURE_3D,0,0,0,0,Z.width,Z.height,Z.depth,ct,C,Z.data)):e.texImage3D(i.TEXTURE_3D,0,K,Z.width,Z.height,Z.depth,0,ct,C,Z.data);else if(y.isFramebufferTexture){if(lt)if(ot)e.texStorage2D(i.TEXTURE_2D,Wt,K,Z.width,Z.height);else{let rt=Z.width,Rt=Z.height;for(let Ht=0;Ht<Wt;Ht++)e.texImage2D(i.TEXTURE_2D,Ht,K,rt,Rt,0,ct,C,null),rt>>=1,Rt>>=1}}else if(y.isHTMLTexture){if("texElementImage2D"in i){let rt=i.canvas;if(rt.hasAttribute("layoutsubtree")||rt.setAttribute("layoutsubtree","true"),Z.parentNode!==rt){rt.appendChild(Z),u.add(y),rt.onpaint=Rt=>{let Ht=Rt.changedElements;for(let mt of u)Ht.includes(mt.image)&&(mt.needsUpdate=!0)},rt.requestPaint();return}if(i.texElementImage2D.length===3)i.texElementImage2D(i.TEXTURE_2D,i.RGBA8,Z);else{let Ht=i.RGBA,mt=i.RGBA,re=i.UNSIGNED_BYTE;i.texElementImage2D(i.TEXTURE_2D,0,Ht,mt,re,Z)}i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MIN_FILTER,i.LINEAR),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_S,i.CLAMP_TO_EDGE),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_T,i.CLAMP_TO_EDGE)}}else if(ht.length>0){if(ot&&lt){let rt=Ft(ht[0]);e.texStorage2D(i.TEXTURE_2D,Wt,K,rt.width,rt.height)}for(let rt=0,Rt=ht.length;rt<Rt;rt++)W=ht[rt],ot?At&&e.texSubImage2D(i.TEXTURE_2D,rt,0,0,ct,C,W):e.texImage2D(i.TEXTURE_2D,rt,K,ct,C,W);y.generateMipmaps=!1}else if(ot){if(lt){let rt=Ft(Z);e.texStorage2D(i.TEXTURE_2D,Wt,K,rt.width,rt.height)}At&&e.texSubImage2D(i.TEXTURE_2D,0,0,0,ct,C,Z)}else e.texImage2D(i.TEXTURE_2D,0,K,ct,C,Z);w(y)&&y.mipmapsAutoUpdate===!0&&b(it),dt.__version=at.version,y.onUpdate&&y.onUpdate(y)}T.__version=y.version}function je(T,y,F){if(y.image.length!==6)return;let it=oe(T,y),Q=y.source;e.bindTexture(i.TEXTURE_CUBE_MAP,T.__webglTexture,i.TEXTURE0+F);let at=n.get(Q);if(Q.version!==at.__version||it===!0){e.activeTexture(i.TEXTURE0+F);let dt=Kt.getPrimaries(Kt.workingColorSpace),$=y.colorSpace===oi?null:Kt.getPrimaries(y.colorSpace),Z=y.colorSpace===oi||dt===$?i.NONE:i.BROWSER_DEFAULT_WEBGL;e.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,y.flipY),e.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,y.premultiplyAlpha),e.pixelStorei(i.UNPACK_ALIGNMENT,y.unpackAlignment),e.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,Z);let ct=y.isCompressedTexture||y.image[0].isCompressedTexture,C=y.image[0]&&y.image[0].isDataTexture,K=[];for(let mt=0;mt<6;mt++)!ct&&!C?K[mt]=S(y.image[mt],!0,s.maxCubemapSize):K[mt]=C?y.image[mt].image:y.image[mt],K[mt]=Pt(y,K[mt]);let W=K[0],ht=r.convert(y.format,y.colorSpace),ot=r.convert(y.type),lt=A(y.internalFormat,ht,ot,y.normalized,y.colorSpace),At=y.isVideoTexture!==!0,Wt=at.__version===void 0||it===!0,rt=Q.dataReady,Rt=E(y,W);se(i.TEXTURE_CUBE_MAP,y);let Ht;if(y.isDepthTexture){if(lt=_(y.format===ri,y.type),Wt)if(At)e.texStorage2D(i.TEXTURE_CUBE_MAP,1,lt,W.width,W.height);else for(let mt=0;mt<6;mt++)e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,0,lt,W.width,W.height,0,ht,ot,null)}else if(ct){At&&Wt&&e.texStorage2D(i.TEXTURE_CUBE_MAP,Rt,lt,W.width,W.height);for(let mt=0;mt<6;mt++){Ht=K[mt].mipmaps;for(let re=0;re<Ht.length;re++){let Ie=Ht[re];y.format!==Ke?ht!==null?At?rt&&e.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,re,0,0,Ie.width,Ie.height,ht,Ie.data):e.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,re,lt,Ie.width,Ie.height,0,Ie.data):Lt("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):At?rt&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,re,0,0,Ie.width,Ie.height,ht,ot,Ie.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,re,lt,Ie.width,Ie.height,0,ht,ot,Ie.data)}}}else{if(Ht=y.mipmaps,At&&Wt){Ht.length>0&&Rt++;let mt=Ft(K[0]);e.texStorage2D(i.TEXTURE_CUBE_MAP,Rt,lt,mt.width,mt.height)}for(let mt=0;mt<6;mt++)if(C){At?rt&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,0,0,0,K[mt].width,K[mt].height,ht,ot,K[mt].data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,0,lt,K[mt].width,K[mt].height,0,ht,ot,K[mt].data);for(let re=0;re<Ht.length;re++){let hi=Ht[re].image[mt].image;At?rt&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,re+1,0,0,hi.width,hi.height,ht,ot,hi.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,re+1,lt,hi.width,hi.height,0,ht,ot,hi.data)}}else{At?rt&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,0,0,0,ht,ot,K[mt]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,0,lt,ht,ot,K[mt]);for(let re=0;re<Ht.length;re++){let Ie=Ht[re];At?rt&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,re+1,0,0,ht,ot,Ie.image[mt]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,re+1,lt,ht,ot,Ie.image[mt])}}}w(y)&&y.mipmapsAutoUpdate===!0&&b(i.TEXTURE_CUBE_MAP),at.__version=Q.version,y.onUpdate&&y.onUpdate(y)}T.__version=y.version}function fe(T,y,F,it,Q,at){let dt=r.convert(F.format,F.colorSpace),$=r.convert(F.type),Z=A(F.internalFormat,dt,$,F.normalized,F.colorSpace),ct=n.get(y),C=n.get(F);if(C.__renderTarget=y,!ct.__hasExternalTextures){let K=Math.max(1,y.width>>at),W=Math.max(1,y.height>>at);Q===i.TEXTURE_3D||Q===i.TEXTURE_2D_ARRAY?e.texImage3D(Q,at,Z,K,W,y.depth,0,dt,$,null):e.texImage2D(Q,at,Z,K,W,0,dt,$,null)}e.bindFramebuffer(i.FRAMEBUFFER,T),pt(y)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,it,Q,C.__webglTexture,0,de(y)):(Q===i.TEXTURE_2D||Q>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&Q<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,it,Q,C.__webglTexture,at),e.bindFramebuffer(i.FRAMEBUFFER,null)}function On(T,y,F){if(i.bindRenderbuffer(i.RENDERBUFFER,T),y.depthBuffer){let it=y.depthTexture,Q=it&&it.isDepthTexture?it.type:null,at=_(y.stencilBuffer,Q),dt=y.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;pt(y)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,de(y),at,y.width,y.height):F?i.renderbufferStorageMultisample(i.RENDERBUFFER,de(y),at,y.width,y.height):i.renderbufferStorage(i.RENDERBUFFER,at,y.width,y.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,dt,i.RENDERBUFFER,T)}else{let it=y.textures;for(let Q=0;Q<it.length;Q++){let at=it[Q],dt=r.convert(at.format,at.colorSpace),$=r.convert(at.type),Z=A(at.internalFormat,dt,$,at.normalized,at.colorSpace);pt(y)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,de(y),Z,y.width,y.height):F?i.renderbufferStorageMultisample(i.RENDERBUFFER,de(y),Z,y.width,y.height):i.renderbufferStorage(i.RENDERBUFFER,Z,y.width,y.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function Pe(T,y,F){let it=y.isWebGLCubeRenderTarget===!0;if(e.bindFramebuffer(i.FRAMEBUFFER,T),!(y.depthTexture&&y.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let Q=n.get(y.depthTexture);Q.__renderTarget=y;let at=it?y.depthTexture.image[0]:y.depthTexture.image;(!Q.__webglTexture||at.width!==y.width||at.height!==y.height)&&(at.width=y.width,at.height=y.height,y.depthTexture.needsUpdate=!0),it?xt(y.depthTexture,0):_t(y.depthTexture,0);let dt=Q.__webglTexture,$=de(y),Z=it?i.TEXTURE_CUBE_MAP_POSITIVE_X+F:i.TEXTURE_2D,ct=y.depthTexture.format===ri?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;if(y.depthTexture.format===ni)pt(y)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ct,Z,dt,0,$):i.framebufferTexture2D(i.FRAMEBUFFER,ct,Z,dt,0);else if(y.depthTexture.format===ri)pt(y)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ct,Z,dt,0,$):i.framebufferTexture2D(i.FRAMEBUFFER,ct,Z,dt,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function gn(T){let y=n.get(T),F=T.isWebGLCubeRenderTarget===!0;if(y.__boundDepthTexture!==T.depthTexture){let it=T.depthTexture;if(y.__depthDisposeCallback&&y.__depthDisposeCallback(),it){let Q=()=>{delete y.__boundDepthTexture,delete y.__depthDisposeCallback,it.removeEventListener("dispose",Q)};it.addEventListener("dispose",Q),y.__depthDisposeCallback=Q}y.__boundDepthTexture=it}if(T.depthTexture&&!y.__autoAllocateDepthBuffer)if(F)for(let it=0;it<6;it++)Pe(y.__webglFramebuffer[it],T,it);else T.texture.mipmaps.length>0?Pe(y.__webglFramebuffer[0],T,0):Pe(y.__webglFramebuffer,T,0);else if(F){y.__webglDepthbuffer=[];for(let it=0;it<6;it++)if(e.bindFramebuffer(i.FRAMEBUFFER,y.__webglFramebuffer[it]),y.__webglDepthbuffer[it]===void 0)y.__webglDepthbuffer[it]=i.createRenderbuffer(),On(y.__webglDepthbuffer[it],T,!1);else{let Q=T.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,at=y.__webglDepthbuffer[it];i.bindRenderbuffer(i.RENDERBUFFER,at),i.framebufferRenderbuffer(i.FRAMEBUFFER,Q,i.RENDERBUFFER,at)}}else if(T.texture.mipmaps.length>0?e.bindFramebuffer(i.FRAMEBUFFER,y.__webglFramebuffer[0]):e.bindFramebuffer(i.FRAMEBUFFER,y.__webglFramebuffer),y.__webglDepthbuffer===void 0)y.__webglDepthbuffer=i.createRenderbuffer(),On(y.__webglDepthbuffer,T,!1);else{let Q=T.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,at=y.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,at),i.framebufferRenderbuffer(i.FRAMEBUFFER,Q,i.RENDERBUFFER,at)}e.bindFramebuffer(i.FRAMEBUFFER,null)}function _n(T,y,F){let it=n.get(T);y!==void 0&&fe(it.__webglFramebuffer,T,T.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),F!==void 0&&gn(T)}function xn(T){let y=T.texture,F=n.get(T),it=n.get(y);T.addEventListener("dispose",V),k(T);let Q=T.textures,at=T.isWebGLCubeRenderTarget===!0,dt=Q.length>1;if(dt||(it.__webglTexture===void 0&&(it.__webglTexture=i.createTexture()),it.__version=y.version,o.memory.textures++),at){F.__webglFramebuffer=[];for(let $=0;$<6;$++)if(y.mipmaps.length>0){F.__webglFramebuffer[$]=[];for(let Z=0;Z<y.mipmaps.length;Z++)F.__webglFramebuffer[$][Z]=i.createFramebuffer()}else F.__webglFramebuffer[$]=i.createFramebuffer()}else{if(y.mipmaps.length>0){F.__webglFramebuffer=[];for(let $=0;$<y.mipmaps.length;$++)F.__webglFramebuffer[$]=i.createFramebuffer()}else F.__webglFramebuffer=i.createFramebuffer();if(dt)for(let $=0,Z=Q.length;$<Z;$++){let ct=n.get(Q[$]);ct.__webglTexture===void 0&&(ct.__webglTexture=i.createTexture(),o.memory.textures++)}if(T.samples>0&&pt(T)===!1){F.__webglMultisampledFramebuffer=i.createFramebuffer(),F.__webglColorRenderbuffer=[],e.bindFramebuffer(i.FRAMEBUFFER,F.__webglMultisampledFramebuffer);for(let $=0;$<Q.length;$++){let Z=Q[$];F.__webglColorRenderbuffer[$]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,F.__webglColorRenderbuffer[$]);let ct=r.convert(Z.format,Z.colorSpace),C=r.convert(Z.type),K=A(Z.internalFormat,ct,C,Z.normalized,Z.colorSpace,T.isXRRenderTarget===!0),W=de(T);i.renderbufferStorageMultisample(i.RENDERBUFFER,W,K,T.width,T.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+$,i.RENDERBUFFER,F.__webglColorRenderbuffer[$])}i.bindRenderbuffer(i.RENDERBUFFER,null),T.depthBuffer&&(F.__webglDepthRenderbuffer=i.createRenderbuffer(),On(F.__webglDepthRenderbuffer,T,!0)),e.bindFramebuffer(i.FRAMEBUFFER,null)}}if(at){e.bindTexture(i.TEXTURE_CUBE_MAP,it.__webglTexture),se(i.TEXTURE_CUBE_MAP,y);for(let $=0;$<6;$++)if(y.mipmaps.length>0)for(let Z=0;Z<y.mipmaps.length;Z++)fe(F.__webglFramebuffer[$][Z],T,y,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+$,Z);else fe(F.__webglFramebuffer[$],T,y,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+$,0);w(y)?b(i.TEXTURE_CUBE_MAP):y.mipmaps.length>0&&i.texParameteri(i.TEXTURE_CUBE_MAP,i.TEXTURE_MAX_LEVEL,y.mipmaps.length-1),e.unbindTexture()}else if(dt){for(let $=0,Z=Q.length;$<Z;$++){let ct=Q[$],C=n.get(ct),K=i.TEXTURE_2D;(T.isWebGL3DRenderTarget||T.isWebGLArrayRenderTarget)&&(K=T.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),e.bindTexture(K,C.__webglTexture),se(K,ct),fe(F.__webglFramebuffer,T,ct,i.COLOR_ATTACHMENT0+$,K,0),w(ct)&&b(K)}e.unbindTexture()}else{let $=i.TEXTURE_2D;if((T.isWebGL3DRenderTarget||T.isWebGLArrayRenderTarget)&&($=T.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),e.bindTexture($,it.__webglTexture),se($,y),y.mipmaps.length>0)for(let Z=0;Z<y.mipmaps.length;Z++)fe(F.__webglFramebuffer[Z],T,y,i.COLOR_ATTACHMENT0,$,Z);else fe(F.__webglFramebuffer,T,y,i.COLOR_ATTACHMENT0,$,0);w(y)?b($):y.mipmaps.length>0&&i.texParameteri($,i.TEXTURE_MAX_LEVEL,y.mipmaps.length-1),e.unbindTexture()}T.depthBuffer&&gn(T)}function D(T){let y=T.textures;for(let F=0,it=y.length;F<it;F++){let Q=y[F];if(w(Q)&&Q.mipmapsAutoUpdate===!0){let at=R(T),dt=n.get(Q).__webglTexture;e.bindTexture(at,dt),b(at),e.unbindTexture()}}}let yn=[];function ue(T){if(T.samples>0){if(pt(T)===!1){let y=T.textures,F=T.width,it=T.height,Q=i.COLOR_BUFFER_BIT,at=T.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,dt=n.get(T),$=y.length>1;if($)for(let ct=0;ct<y.length;ct++)e.bindFramebuffer(i.FRAMEBUFFER,dt.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ct,i.RENDERBUFFER,null),e.bindFramebuffer(i.FRAMEBUFFER,dt.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ct,i.TEXTURE_2D,null,0);e.bindFramebuffer(i.READ_FRAMEBUFFER,dt.__webglMultisampledFramebuffer),T.texture.mipmaps.length>0?e.bindFramebuffer(i.DRAW_FRAMEBUFFER,dt.__webglFramebuffer[0]):e.bindFramebuffer(i.DRAW_FRAMEBUFFER,dt.__webglFramebuffer);for(let ct=0;ct<y.length;ct++){if(T.resolveDepthBuffer&&(T.depthBuffer&&(Q|=i.DEPTH_BUFFER_BIT),T.stencilBuffer&&T.resolveStencilBuffer&&(Q|=i.STENCIL_BUFFER_BIT)),$){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,dt.__webglColorRenderbuffer[ct]);let C=n.get(y[ct]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,C,0)}i.blitFramebuffer(0,0,F,it,0,0,F,it,Q,i.NEAREST),l===!0&&(yn.length=0,yn.push(i.COLOR_ATTACHMENT0+ct),T.depthBuffer&&T.storeMultisampledDepthBuffer===!1&&yn.push(at),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,yn))}if(e.bindFramebuffer(i.READ_FRAMEBUFFER,null),e.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),$)for(let ct=0;ct<y.length;ct++){e.bindFramebuffer(i.FRAMEBUFFER,dt.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ct,i.RENDERBUFFER,dt.__webglColorRenderbuffer[ct]);let C=n.get(y[ct]).__webglTexture;e.bindFramebuffer(i.FRAMEBUFFER,dt.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ct,i.TEXTURE_2D,C,0)}e.bindFramebuffer(i.DRAW_FRAMEBUFFER,dt.__webglMultisampledFramebuffer)}else if(T.depthBuffer&&T.storeMultisampledDepthBuffer===!1&&l){let y=T.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[y])}}}function de(T){return Math.min(s.maxSamples,T.samples)}function pt(T){let y=n.get(T);return T.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&y.__useRenderToTexture!==!1}function Te(T){let y=o.render.frame;h.get(T)!==y&&(h.set(T,y),T.update())}function Pt(T,y){let F=T.colorSpace,it=T.format,Q=T.type;return T.isCompressedTexture===!0||T.isVideoTexture===!0||F!==tr&&F!==oi&&(Kt.getTransfer(F)===ie?(it!==Ke||Q!==Je)&&Lt("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):Nt("WebGLTextures: Unsupported texture color space:",F)),y}function Ft(T){return typeof HTMLImageElement<"u"&&T instanceof HTMLImageElement?(c.width=T.naturalWidth||T.width,c.height=T.naturalHeight||T.height):typeof VideoFrame<"u"&&T instanceof VideoFrame?(c.width=T.displayWidth,c.height=T.displayHeight):(c.width=T.width,c.height=T.height),c}this.allocateTextureUnit=Bt,this.resetTextureUnits=tt,this.getTextureUnits=et,this.setTextureUnits=wt,this.setTexture2D=_t,this.setTexture2DArray=Mt,this.setTexture3D=Ct,this.setTextureCube=xt,this.rebindTextures=_n,this.setupRenderTarget=xn,this.updateRenderTargetMipmap=D,this.updateMultisampleRenderTarget=ue,this.setupDepthRenderbuffer=gn,this.setupFrameBufferTexture=fe,this.useMultisampledRTT=pt,this.dispose=q}function Yv(i,t){function e(n,s=oi){let r,o=Kt.getTransfer(s);if(n===Je)return i.UNSIGNED_BYTE;if(n===ha)return i.UNSIGNED_SHORT_4_4_4_4;if(n===ua)return i.UNSIGNED_SHORT_5_5_5_1;if(n===rh)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===oh)return i.UNSIGNED_INT_10F_11F_11F_REV;if(n===ih)return i.BYTE;if(n===sh)return i.SHORT;if(n===Ts)return i.UNSIGNED_SHORT;if(n===ca)return i.INT;if(n===Cn)return i.UNSIGNED_INT;if(n===pn)return i.FLOAT;if(n===Pn)return i.HALF_FLOAT;if(n===ah)return i.ALPHA;if(n===lh)return i.RGB;if(n===Ke)return i.RGBA;if(n===ni)return i.DEPTH_COMPONENT;if(n===ri)return i.DEPTH_STENCIL;if(n===ch)return i.RED;if(n===da)return i.RED_INTEGER;if(n===Ci)return i.RG;if(n===fa)return i.RG_INTEGER;if(n===pa)return i.RGBA_INTEGER;if(n===Sr||n===wr||n===Er||n===Tr)if(o===ie)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===Sr)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===wr)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===Er)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===Tr)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===Sr)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===wr)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===Er)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===Tr)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===ma||n===ga||n===_a||n===xa)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===ma)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===ga)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===_a)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===xa)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===ya||n===va||n===Ma||n===ba||n===Sa||n===Ar||n===wa)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(n===ya||n===va)return o===ie?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===Ma)return o===ie?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(n===ba)return r.COMPRESSED_R11_EAC;if(n===Sa)return r.COMPRESSED_SIGNED_R11_EAC;if(n===Ar)return r.COMPRESSED_RG11_EAC;if(n===wa)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(n===Ea||n===Ta||n===Aa||n===Ra||n===Ca||n===Pa||n===Ia||n===La||n===Da||n===Na||n===Oa||n===Ua||n===Fa||n===Ba)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(n===Ea)return o===ie?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===Ta)return o===ie?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===Aa)return o===ie?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===Ra)return o===ie?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===Ca)return o===ie?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===Pa)return o===ie?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===Ia)return o===ie?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===La)return o===ie?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===Da)return o===ie?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===Na)return o===ie?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===Oa)return o===ie?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===Ua)return o===ie?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===Fa)return o===ie?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===Ba)return o===ie?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===ka||n===za||n===Va)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(n===ka)return o===ie?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===za)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===Va)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===Ga||n===Ha||n===Rr||n===Wa)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(n===Ga)return r.COMPRESSED_RED_RGTC1_EXT;if(n===Ha)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===Rr)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===Wa)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===qi?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:e}}var Zv=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,Jv=`
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

}`,Ih=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e){if(this.texture===null){let n=new ur(t.texture);(t.depthNear!==e.depthNear||t.depthFar!==e.depthFar)&&(this.depthNear=t.depthNear,this.depthFar=t.depthFar),this.texture=n}}getMesh(t){if(this.texture!==null&&this.mesh===null){let e=t.cameras[0].viewport,n=new zn({vertexShader:Zv,fragmentShader:Jv,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new tn(new gr(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},Lh=class extends An{constructor(t,e){super();let n=this,s=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,u=null,d=null,f=null,m=null,x=typeof XRWebGLBinding<"u",p=new Ih,g={},S=e.getContextAttributes(),w=null,b=null,R=[],A=[],_=new It,E=null,k=null,L=new Xe;L.viewport=new ge;let O=new Xe;O.viewport=new ge;let V=[L,O],Y=new ra,I=null,q=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(J){let _t=R[J];return _t===void 0&&(_t=new xs,R[J]=_t),_t.getTargetRaySpace()},this.getControllerGrip=function(J){let _t=R[J];return _t===void 0&&(_t=new xs,R[J]=_t),_t.getGripSpace()},this.getHand=function(J){let _t=R[J];return _t===void 0&&(_t=new xs,R[J]=_t),_t.getHandSpace()};function j(J){let _t=A.indexOf(J.inputSource);if(_t===-1)return;let Mt=R[_t];Mt!==void 0&&(Mt.update(J.inputSource,J.frame,c||o),Mt.dispatchEvent({type:J.type,data:J.inputSource}))}function H(){s.removeEventListener("select",j),s.removeEventListener("selectstart",j),s.removeEventListener("selectend",j),s.removeEventListener("squeeze",j),s.removeEventListener("squeezestart",j),s.removeEventListener("squeezeend",j),s.removeEventListener("end",H),s.removeEventListener("inputsourceschange",st);for(let J=0;J<R.length;J++){let _t=A[J];_t!==null&&(A[J]=null,R[J].disconnect(_t))}I=null,q=null,p.reset();for(let J in g)delete g[J];if(t.setRenderTarget(w),f=null,d=null,u=null,s=null,b=null,Bt.stop(),n.isPresenting=!1,t.setPixelRatio(E),t.setSize(_.width,_.height,!1),k!==null){let J=k.camera;J.fov=k.fov,J.zoom=k.zoom,J.updateProjectionMatrix(),k=null}n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(J){r=J,n.isPresenting===!0&&Lt("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(J){a=J,n.isPresenting===!0&&Lt("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(J){c=J},this.getBaseLayer=function(){return d!==null?d:f},this.getBinding=function(){return u===null&&x&&(u=new XRWebGLBinding(s,e)),u},this.getFrame=function(){return m},this.getSession=function(){return s},this.setSession=async function(J){if(s=J,s!==null){if(w=t.getRenderTarget(),s.addEventListener("select",j),s.addEventListener("selectstart",j),s.addEventListener("selectend",j),s.addEventListener("squeeze",j),s.addEventListener("squeezestart",j),s.addEventListener("squeezeend",j),s.addEventListener("end",H),s.addEventListener("inputsourceschange",st),S.xrCompatible!==!0&&await e.makeXRCompatible(),E=t.getPixelRatio(),t.getSize(_),x&&"createProjectionLayer"in XRWebGLBinding.prototype){let Mt=null,Ct=null,xt=null;S.depth&&(xt=S.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,Mt=S.stencil?ri:ni,Ct=S.stencil?qi:Cn);let Vt={colorFormat:e.RGBA8,depthFormat:xt,scaleFactor:r};u=this.getBinding(),d=u.createProjectionLayer(Vt),s.updateRenderState({layers:[d]}),t.setPixelRatio(1),t.setSize(d.textureWidth,d.textureHeight,!1),b=new cn(d.textureWidth,d.textureHeight,{format:Ke,type:Je,depthTexture:new ii(d.textureWidth,d.textureHeight,Ct,void 0,void 0,void 0,void 0,void 0,void 0,Mt),stencilBuffer:S.stencil,colorSpace:t.outputColorSpace,samples:S.antialias?4:0,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}else{let Mt={antialias:S.antialias,alpha:!0,depth:S.depth,stencil:S.stencil,framebufferScaleFactor:r};f=new XRWebGLLayer(s,e,Mt),s.updateRenderState({baseLayer:f}),t.setPixelRatio(1),t.setSize(f.framebufferWidth,f.framebufferHeight,!1),b=new cn(f.framebufferWidth,f.framebufferHeight,{format:Ke,type:Je,colorSpace:t.outputColorSpace,stencilBuffer:S.stencil,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}b.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),Bt.setContext(s),Bt.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return p.getDepthTexture()};function st(J){for(let _t=0;_t<J.removed.length;_t++){let Mt=J.removed[_t],Ct=A.indexOf(Mt);Ct>=0&&(A[Ct]=null,R[Ct].disconnect(Mt))}for(let _t=0;_t<J.added.length;_t++){let Mt=J.added[_t],Ct=A.indexOf(Mt);if(Ct===-1){for(let Vt=0;Vt<R.length;Vt++)if(Vt>=A.length){A.push(Mt),Ct=Vt;break}else if(A[Vt]===null){A[Vt]=Mt,Ct=Vt;break}if(Ct===-1)break}let xt=R[Ct];xt&&xt.connect(Mt)}}function X(J,_t){_t===null?J.matrixWorld.copy(J.matrix):J.matrixWorld.multiplyMatrices(_t.matrixWorld,J.matrix),J.matrixWorldInverse.copy(J.matrixWorld).invert()}this.updateCamera=function(J){if(s===null)return;let _t=J.near,Mt=J.far;p.texture!==null&&(p.depthNear>0&&(_t=p.depthNear),p.depthFar>0&&(Mt=p.depthFar)),Y.near=O.near=L.near=_t,Y.far=O.far=L.far=Mt,(I!==Y.near||q!==Y.far)&&(s.updateRenderState({depthNear:Y.near,depthFar:Y.far}),I=Y.near,q=Y.far),Y.layers.mask=J.layers.mask|6,L.layers.mask=Y.layers.mask&-5,O.layers.mask=Y.layers.mask&-3;let Ct=J.parent,xt=Y.cameras;X(Y,Ct);for(let Vt=0;Vt<xt.length;Vt++)X(xt[Vt],Ct);Y.projectionMatrix.copy(L.projectionMatrix),Y.projectionMatrixInverse.copy(L.projectionMatrixInverse),k===null&&J.isPerspectiveCamera&&(k={camera:J,fov:J.fov,zoom:J.zoom}),tt(J,Y,Ct)};function tt(J,_t,Mt){Mt===null?J.matrix.copy(_t.matrixWorld):(J.matrix.copy(Mt.matrixWorld),J.matrix.invert(),J.matrix.multiply(_t.matrixWorld)),J.matrix.decompose(J.position,J.quaternion,J.scale),J.updateMatrixWorld(!0),J.projectionMatrix.copy(_t.projectionMatrix),J.projectionMatrixInverse.copy(_t.projectionMatrixInverse),J.isPerspectiveCamera&&(J.fov=ms*2*Math.atan(1/J.projectionMatrix.elements[5]),J.zoom=1)}this.getCamera=function(){return Y},this.getFoveation=function(){if(!(d===null&&f===null))return l},this.setFoveation=function(J){l=J,d!==null&&(d.fixedFoveation=J),f!==null&&f.fixedFoveation!==void 0&&(f.fixedFoveation=J)},this.hasDepthSensing=function(){return p.texture!==null},this.getDepthSensingMesh=function(){return p.getMesh(Y)},this.getCameraTexture=function(J){return g[J]};let et=null;function wt(J,_t){if(h=_t.getViewerPose(c||o),m=_t,h!==null){let Mt=h.views;f!==null&&(t.setRenderTargetFramebuffer(b,f.framebuffer),t.setRenderTarget(b));let Ct=!1;Mt.length!==Y.cameras.length&&(Y.cameras.length=0,Ct=!0);for(let Dt=0;Dt<Mt.length;Dt++){let se=Mt[Dt],oe=null;if(f!==null)oe=f.getViewport(se);else{let Oe=u.getViewSubImage(d,se);oe=Oe.viewport,Dt===0&&(t.setRenderTargetTextures(b,Oe.colorTexture,Oe.depthStencilTexture),t.setRenderTarget(b))}let Yt=V[Dt];Yt===void 0&&(Yt=new Xe,Yt.layers.enable(Dt),Yt.viewport=new ge,V[Dt]=Yt),Yt.matrix.fromArray(se.transform.matrix),Yt.matrix.decompose(Yt.position,Yt.quaternion,Yt.scale),Yt.projectionMatrix.fromArray(se.projectionMatrix),Yt.projectionMatrixInverse.copy(Yt.projectionMatrix).invert(),Yt.viewport.set(oe.x,oe.y,oe.width,oe.height),Dt===0&&(Y.matrix.copy(Yt.matrix),Y.matrix.decompose(Y.position,Y.quaternion,Y.scale)),Ct===!0&&Y.cameras.push(Yt)}let xt=s.enabledFeatures;if(xt&&xt.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&x){u=n.getBinding();let Dt=u.getDepthInformation(Mt[0]);Dt&&Dt.isValid&&Dt.texture&&p.init(Dt,s.renderState)}if(xt&&xt.includes("camera-access")&&x){t.state.unbindTexture(),u=n.getBinding();for(let Dt=0;Dt<Mt.length;Dt++){let se=Mt[Dt].camera;if(se){let oe=g[se];oe||(oe=new ur,g[se]=oe);let Yt=u.getCameraImage(se);oe.sourceTexture=Yt}}}}for(let Mt=0;Mt<R.length;Mt++){let Ct=A[Mt],xt=R[Mt];Ct!==null&&xt!==void 0&&xt.update(Ct,_t,c||o)}et&&et(J,_t),_t.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:_t}),m=null}let Bt=new Hf;Bt.setAnimationLoop(wt),this.setAnimationLoop=function(J){et=J},this.dispose=function(){}}},Kv=new Qt,Qf=new Ot;Qf.set(-1,0,0,0,1,0,0,0,1);function jv(i,t){function e(p,g){p.matrixAutoUpdate===!0&&p.updateMatrix(),g.value.copy(p.matrix)}function n(p,g){g.color.getRGB(p.fogColor.value,yh(i)),g.isFog?(p.fogNear.value=g.near,p.fogFar.value=g.far):g.isFogExp2&&(p.fogDensity.value=g.density)}function s(p,g,S,w,b){g.isNodeMaterial?g.uniformsNeedUpdate=!1:g.isMeshBasicMaterial?r(p,g):g.isMeshLambertMaterial?(r(p,g),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)):g.isMeshToonMaterial?(r(p,g),u(p,g)):g.isMeshPhongMaterial?(r(p,g),h(p,g),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)):g.isMeshStandardMaterial?(r(p,g),d(p,g),g.isMeshPhysicalMaterial&&f(p,g,b)):g.isMeshMatcapMaterial?(r(p,g),m(p,g)):g.isMeshDepthMaterial?r(p,g):g.isMeshDistanceMaterial?(r(p,g),x(p,g)):g.isMeshNormalMaterial?r(p,g):g.isLineBasicMaterial?(o(p,g),g.isLineDashedMaterial&&a(p,g)):g.isPointsMaterial?l(p,g,S,w):g.isSpriteMaterial?c(p,g):g.isShadowMaterial?(p.color.value.copy(g.color),p.opacity.value=g.opacity):g.isShaderMaterial&&(g.uniformsNeedUpdate=!1)}function r(p,g){p.opacity.value=g.opacity,g.color&&p.diffuse.value.copy(g.color),g.emissive&&p.emissive.value.copy(g.emissive).multiplyScalar(g.emissiveIntensity),g.map&&(p.map.value=g.map,e(g.map,p.mapTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.bumpMap&&(p.bumpMap.value=g.bumpMap,e(g.bumpMap,p.bumpMapTransform),p.bumpScale.value=g.bumpScale,g.side===Ze&&(p.bumpScale.value*=-1)),g.normalMap&&(p.normalMap.value=g.normalMap,e(g.normalMap,p.normalMapTransform),p.normalScale.value.copy(g.normalScale),g.side===Ze&&p.normalScale.value.negate()),g.displacementMap&&(p.displacementMap.value=g.displacementMap,e(g.displacementMap,p.displacementMapTransform),p.displacementScale.value=g.displacementScale,p.displacementBias.value=g.displacementBias),g.emissiveMap&&(p.emissiveMap.value=g.emissiveMap,e(g.emissiveMap,p.emissiveMapTransform)),g.specularMap&&(p.specularMap.value=g.specularMap,e(g.specularMap,p.specularMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest);let S=t.get(g),w=S.envMap,b=S.envMapRotation;w&&(p.envMap.value=w,p.envMapRotation.value.setFromMatrix4(Kv.makeRotationFromEuler(b)).transpose(),w.isCubeTexture&&w.isRenderTargetTexture===!1&&p.envMapRotation.value.premultiply(Qf),p.reflectivity.value=g.reflectivity,p.ior.value=g.ior,p.refractionRatio.value=g.refractionRatio),g.lightMap&&(p.lightMap.value=g.lightMap,p.lightMapIntensity.value=g.lightMapIntensity,e(g.lightMap,p.lightMapTransform)),g.aoMap&&(p.aoMap.value=g.aoMap,p.aoMapIntensity.value=g.aoMapIntensity,e(g.aoMap,p.aoMapTransform))}function o(p,g){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,g.map&&(p.map.value=g.map,e(g.map,p.mapTransform))}function a(p,g){p.dashSize.value=g.dashSize,p.totalSize.value=g.dashSize+g.gapSize,p.scale.value=g.scale}function l(p,g,S,w){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,p.size.value=g.size*S,p.scale.value=w*.5,g.map&&(p.map.value=g.map,e(g.map,p.uvTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest)}function c(p,g){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,p.rotation.value=g.rotation,g.map&&(p.map.value=g.map,e(g.map,p.mapTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest)}function h(p,g){p.specular.value.copy(g.specular),p.shininess.value=Math.max(g.shininess,1e-4)}function u(p,g){g.gradientMap&&(p.gradientMap.value=g.gradientMap)}function d(p,g){p.metalness.value=g.metalness,g.metalnessMap&&(p.metalnessMap.value=g.metalnessMap,e(g.metalnessMap,p.metalnessMapTransform)),p.roughness.value=g.roughness,g.roughnessMap&&(p.roughnessMap.value=g.roughnessMap,e(g.roughnessMap,p.roughnessMapTransform)),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)}function f(p,g,S){p.ior.value=g.ior,g.diffuseRoughness>0&&(p.diffuseRoughness.value=g.diffuseRoughness,g.diffuseRoughnessMap&&(p.diffuseRoughnessMap.value=g.diffuseRoughnessMap,e(g.diffuseRoughnessMap,p.diffuseRoughnessMapTransform))),g.sheen>0&&(p.sheenColor.value.copy(g.sheenColor).multiplyScalar(g.sheen),p.sheenRoughness.value=g.sheenRoughness,g.sheenColorMap&&(p.sheenColorMap.value=g.sheenColorMap,e(g.sheenColorMap,p.sheenColorMapTransform)),g.sheenRoughnessMap&&(p.sheenRoughnessMap.value=g.sheenRoughnessMap,e(g.sheenRoughnessMap,p.sheenRoughnessMapTransform))),g.clearcoat>0&&(p.clearcoat.value=g.clearcoat,p.clearcoatRoughness.value=g.clearcoatRoughness,g.clearcoatMap&&(p.clearcoatMap.value=g.clearcoatMap,e(g.clearcoatMap,p.clearcoatMapTransform)),g.clearcoatRoughnessMap&&(p.clearcoatRoughnessMap.value=g.clearcoatRoughnessMap,e(g.clearcoatRoughnessMap,p.clearcoatRoughnessMapTransform)),g.clearcoatNormalMap&&(p.clearcoatNormalMap.value=g.clearcoatNormalMap,e(g.clearcoatNormalMap,p.clearcoatNormalMapTransform),p.clearcoatNormalScale.value.copy(g.clearcoatNormalScale),g.side===Ze&&p.clearcoatNormalScale.value.negate())),g.dispersion>0&&(p.dispersion.value=g.dispersion),g.retroreflectivity>0&&(p.retroreflectivity.value=g.retroreflectivity),g.iridescence>0&&(p.iridescence.value=g.iridescence,p.iridescenceIOR.value=g.iridescenceIOR,p.iridescenceThicknessMinimum.value=g.iridescenceThicknessMinimum,p.iridescenceThicknessMaximum.value=g.iridescenceThicknessMaximum,g.iridescenceMap&&(p.iridescenceMap.value=g.iridescenceMap,e(g.iridescenceMap,p.iridescenceMapTransform)),g.iridescenceThicknessMap&&(p.iridescenceThicknessMap.value=g.iridescenceThicknessMap,e(g.iridescenceThicknessMap,p.iridescenceThicknessMapTransform))),g.transmission>0&&(p.transmission.value=g.transmission,p.transmissionSamplerMap.value=S.texture,p.transmissionSamplerSize.value.set(S.width,S.height),g.transmissionMap&&(p.transmissionMap.value=g.transmissionMap,e(g.transmissionMap,p.transmissionMapTransform)),p.thickness.value=g.thickness,g.thicknessMap&&(p.thicknessMap.value=g.thicknessMap,e(g.thicknessMap,p.thicknessMapTransform)),p.attenuationDistance.value=g.attenuationDistance,p.attenuationColor.value.copy(g.attenuationColor)),g.anisotropy>0&&(p.anisotropyVector.value.set(g.anisotropy*Math.cos(g.anisotropyRotation),g.anisotropy*Math.sin(g.anisotropyRotation)),g.anisotropyMap&&(p.anisotropyMap.value=g.anisotropyMap,e(g.anisotropyMap,p.anisotropyMapTransform))),p.specularIntensity.value=g.specularIntensity,p.specularColor.value.copy(g.specularColor),g.specularColorMap&&(p.specularColorMap.value=g.specularColorMap,e(g.specularColorMap,p.specularColorMapTransform)),g.specularIntensityMap&&(p.specularIntensityMap.value=g.specularIntensityMap,e(g.specularIntensityMap,p.specularIntensityMapTransform))}function m(p,g){g.matcap&&(p.matcap.value=g.matcap)}function x(p,g){let S=t.get(g).light;p.referencePosition.value.setFromMatrixPosition(S.matrixWorld),p.nearDistance.value=S.shadow.camera.near,p.farDistance.value=S.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function Qv(i,t,e,n){let s={},r={};function o(S,w){let b=w.program;n.uniformBlockBinding(S,b,s[S.id])}function a(S,w){let b=s[S.id];b===void 0&&(m(S),b=l(S),s[S.id]=b,S.addEventListener("dispose",p));let R=w.program;n.updateUBOMapping(S,R);let A=t.render.frame;r[S.id]!==A&&(c(S),r[S.id]=A)}function l(S){let w=i.createBuffer(),b=S.__size,R=S.usage;return i.bindBuffer(i.UNIFORM_BUFFER,w),i.bufferData(i.UNIFORM_BUFFER,b,R),i.bindBuffer(i.UNIFORM_BUFFER,null),w}function c(S){let w=s[S.id],b=S.uniforms,R=S.__cache;i.bindBuffer(i.UNIFORM_BUFFER,w);for(let A=0,_=b.length;A<_;A++){let E=b[A];if(Array.isArray(E))for(let k=0,L=E.length;k<L;k++)h(E[k],A,k,R);else h(E,A,0,R)}i.bindBuffer(i.UNIFORM_BUFFER,null)}function h(S,w,b,R){if(d(S,w,b,R)===!0){let A=S.__offset,_=S.value;if(Array.isArray(_)){let E=0;for(let k=0;k<_.length;k++){let L=_[k],O=x(L,!0);u(L,S.__data,E),E+=O.storage/Float32Array.BYTES_PER_ELEMENT}}else u(_,S.__data,0);i.bufferSubData(i.UNIFORM_BUFFER,A,S.__data)}}function u(S,w,b){typeof S=="number"||typeof S=="boolean"?w[b]=S:S.isMatrix3?(w[b]=S.elements[0],w[b+1]=S.elements[1],w[b+2]=S.elements[2],w[b+3]=0,w[b+4]=S.elements[3],w[b+5]=S.elements[4],w[b+6]=S.elements[5],w[b+7]=0,w[b+8]=S.elements[6],w[b+9]=S.elements[7],w[b+10]=S.elements[8],w[b+11]=0):ArrayBuffer.isView(S)?w.set(S.subarray(0,w.length-b),b):S.toArray(w,b)}function d(S,w,b,R){let A=S.value,_=w+"_"+b;if(Array.isArray(A)){R[_]===void 0&&(R[_]=[]);let E=R[_],k=!1;for(let L=0;L<A.length;L++)f(A[L],E,L)===!0&&(k=!0);return k}return f(A,R,_)}function f(S,w,b){if(w[b]===void 0)return typeof S=="number"||typeof S=="boolean"?w[b]=S:ArrayBuffer.isView(S)?w[b]=S.slice():w[b]=S.clone(),!0;{let R=w[b];if(typeof S=="number"||typeof S=="boolean"){if(R!==S)return w[b]=S,!0}else{if(ArrayBuffer.isView(S))return!0;if(R.equals(S)===!1)return R.copy(S),!0}}return!1}function m(S){let w=S.uniforms,b=0,R=16;for(let _=0,E=w.length;_<E;_++){let k=Array.isArray(w[_])?w[_]:[w[_]];for(let L=0,O=k.length;L<O;L++){let V=k[L],Y=Array.isArray(V.value)?V.value:[V.value],I=Array.isArray(w[_])||Array.isArray(V.value),q=b;for(let H=0,st=Y.length;H<st;H++){let X=Y[H],tt=x(X,I),et=b%R,wt=et%tt.boundary,Bt=et+wt;b+=wt,Bt!==0&&R-Bt<tt.storage&&(b+=R-Bt),H===0&&(q=b),b+=tt.storage}let j=V.type==="int"?Int32Array:V.type==="uint"?Uint32Array:Float32Array;V.__data=new j((b-q)/Float32Array.BYTES_PER_ELEMENT),V.__offset=q}}let A=b%R;return A>0&&(b+=R-A),S.__size=b,S.__cache={},this}function x(S,w){let b={boundary:0,storage:0};return typeof S=="number"||typeof S=="boolean"?(b.boundary=4,b.storage=4):S.isVector2?(b.boundary=8,b.storage=8):S.isVector3||S.isColor?(b.boundary=16,b.storage=12):S.isVector4?(b.boundary=16,b.storage=16):S.isMatrix3?(b.boundary=16,b.storage=48):S.isMatrix4?(b.boundary=16,b.storage=64):S.isTexture?Lt("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(S)?(b.boundary=16,b.storage=S.byteLength):Lt("WebGLRenderer: Unsupported uniform value type.",S),w===!0&&(b.boundary=16,b.storage=Math.ceil(b.storage/16)*16),b}function p(S){let w=S.target;w.removeEventListener("dispose",p),i.deleteBuffer(s[w.id]),delete s[w.id],delete r[w.id]}function g(){for(let S in s)i.deleteBuffer(s[S]);s={},r={}}return{bind:o,update:a,dispose:g}}var tM=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),Wn=null;function eM(){return Wn===null&&(Wn=new bi(tM,16,16,Ci,Pn),Wn.name="DFG_LUT",Wn.minFilter=$e,Wn.magFilter=$e,Wn.wrapS=Fn,Wn.wrapT=Fn,Wn.generateMipmaps=!1,Wn.needsUpdate=!0),Wn}var Ya=class{constructor(t={}){let{canvas:e=lf(),context:n=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:d=!1,outputBufferType:f=Je}=t;this.isWebGLRenderer=!0;let m;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");m=n.getContextAttributes().alpha}else m=o;let x=f,p=new Set([pa,fa,da]),g=new Set([Je,Cn,Ts,qi,ha,ua]),S=new Uint32Array(4),w=new Int32Array(4),b={textures:[],min:[],max:[],resolution:[]},R=null,A=null,_=[],E=[],k=null;this.domElement=e,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=Hn,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let L=this,O=!1,V=null,Y=null,I=null,q=null;this._outputColorSpace=an;let j=0,H=0,st=null,X=-1,tt=null,et=new ge,wt=new ge,Bt=null,J=new Ut(0),_t=0,Mt=e.width,Ct=e.height,xt=1,Vt=null,be=null,Dt=new ge(0,0,Mt,Ct),se=new ge(0,0,Mt,Ct),oe=!1,Yt=new Vi,Oe=new Wo,Ee=!1,je=!1,fe=new Qt,On=new N,Pe=new ge,gn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},_n=!1;function xn(){return st===null?xt:1}let D=n;function yn(v,P){return e.getContext(v,P)}let ue,de,pt,Te,Pt,Ft,T,y,F,it,Q,at,dt,$,Z,ct,C,K,W,ht,ot,lt,At;try{let v={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${"187"}`),e.addEventListener("webglcontextlost",Rt,!1),e.addEventListener("webglcontextrestored",Ht,!1),e.addEventListener("webglcontextcreationerror",mt,!1),D===null){let P="webgl2";if(D=yn(P,v),D===null)throw yn(P)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}Wt()}catch(v){throw e.removeEventListener("webglcontextlost",Rt,!1),e.removeEventListener("webglcontextrestored",Ht,!1),e.removeEventListener("webglcontextcreationerror",mt,!1),Nt("WebGLRenderer: "+v.message),v}function Wt(){ue=new dy(D),ue.init(),ot=new Yv(D,ue),de=new ey(D,ue,t,ot),pt=new qv(D,ue),de.reversedDepthBuffer&&d&&pt.buffers.depth.setReversed(!0),Y=D.createFramebuffer(),I=D.createFramebuffer(),q=D.createFramebuffer(),Te=new my(D),Pt=new Lv,Ft=new $v(D,ue,pt,Pt,de,ot,Te),T=new uy(L),y=new _0(D),lt=new Qx(D,y),F=new fy(D,y,Te,lt),it=new _y(D,F,y,lt,Te),K=new gy(D,de,Ft),Z=new ny(Pt),Q=new Iv(L,T,ue,de,lt,Z),at=new jv(L,Pt),dt=new Nv,$=new zv(ue),C=new jx(L,T,pt,it,m,l),ct=new Xv(L,it,de),At=new Qv(D,Te,de,pt),W=new ty(D,ue,Te),ht=new py(D,ue,Te),Te.programs=Q.programs,L.capabilities=de,L.extensions=ue,L.properties=Pt,L.renderLists=dt,L.shadowMap=ct,L.state=pt,L.info=Te}x!==Je&&(k=new yy(x,e.width,e.height,a,s,r));let rt=new Lh(L,D);this.xr=rt,this.getContext=function(){return D},this.getContextAttributes=function(){return D.getContextAttributes()},this.forceContextLoss=function(){let v=ue.get("WEBGL_lose_context");v&&v.loseContext()},this.forceContextRestore=function(){let v=ue.get("WEBGL_lose_context");v&&v.restoreContext()},this.getPixelRatio=function(){return xt},this.setPixelRatio=function(v){v!==void 0&&(xt=v,this.setSize(Mt,Ct,!1))},this.getSize=function(v){return v.set(Mt,Ct)},this.setSize=function(v,P,z=!0){if(rt.isPresenting){Lt("WebGLRenderer: Can't change size while VR device is presenting.");return}Mt=v,Ct=P,e.width=Math.floor(v*xt),e.height=Math.floor(P*xt),z===!0&&(e.style.width=v+"px",e.style.height=P+"px"),k!==null&&k.setSize(e.width,e.height),this.setViewport(0,0,v,P)},this.getDrawingBufferSize=function(v){return v.set(Mt*xt,Ct*xt).floor()},this.setDrawingBufferSize=function(v,P,z){Mt=v,Ct=P,xt=z,e.width=Math.floor(v*z),e.height=Math.floor(P*z),this.setViewport(0,0,v,P)},this.setEffects=function(v){if(x===Je){Nt("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(v){for(let P=0;P<v.length;P++)if(v[P].isOutputPass===!0){Lt("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}k.setEffects(v||[])},this.getCurrentViewport=function(v){return v.copy(et)},this.getViewport=function(v){return v.copy(Dt)},this.setViewport=function(v,P,z,U){v.isVector4?Dt.set(v.x,v.y,v.z,v.w):Dt.set(v,P,z,U),pt.viewport(et.copy(Dt).multiplyScalar(xn()).round())},this.getScissor=function(v){return v.copy(se)},this.setScissor=function(v,P,z,U){v.isVector4?se.set(v.x,v.y,v.z,v.w):se.set(v,P,z,U),pt.scissor(wt.copy(se).multiplyScalar(xn()).round())},this.getScissorTest=function(){return oe},this.setScissorTest=function(v){pt.setScissorTest(oe=v)},this.setOpaqueSort=function(v){Vt=v},this.setTransparentSort=function(v){be=v},this.getClearColor=function(v){return v.copy(C.getClearColor())},this.setClearColor=function(){C.setClearColor(...arguments)},this.getClearAlpha=function(){return C.getClearAlpha()},this.setClearAlpha=function(){C.setClearAlpha(...arguments)},this.clear=function(v=!0,P=!0,z=!0){let U=0;if(v){let B=!1;if(st!==null){let ft=st.texture.format;B=p.has(ft)}if(B){let ft=st.texture.type,vt=g.has(ft),ut=C.getClearColor(),yt=C.getClearAlpha(),Et=ut.r,kt=ut.g,Zt=ut.b;vt?(S[0]=Et,S[1]=kt,S[2]=Zt,S[3]=yt,D.clearBufferuiv(D.COLOR,0,S)):(w[0]=Et,w[1]=kt,w[2]=Zt,w[3]=yt,D.clearBufferiv(D.COLOR,0,w))}else U|=D.COLOR_BUFFER_BIT}P&&(U|=D.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),z&&(U|=D.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),U!==0&&D.clear(U)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(v){v.setRenderer(this),V=v},this.dispose=function(){e.removeEventListener("webglcontextlost",Rt,!1),e.removeEventListener("webglcontextrestored",Ht,!1),e.removeEventListener("webglcontextcreationerror",mt,!1),C.dispose(),dt.dispose(),$.dispose(),Ft.dispose(),Pt.dispose(),T.dispose(),it.dispose(),F.dispose(),lt.dispose(),At.dispose(),Q.dispose(),rt.dispose(),rt.removeEventListener("sessionstart",ku),rt.removeEventListener("sessionend",zu),Di.stop()};function Rt(v){v.preventDefault(),ph("WebGLRenderer: Context Lost."),O=!0}function Ht(){ph("WebGLRenderer: Context Restored."),O=!1;let v=Te.autoReset,P=ct.enabled,z=ct.autoUpdate,U=ct.needsUpdate,B=ct.type;Wt(),Te.autoReset=v,ct.enabled=P,ct.autoUpdate=z,ct.needsUpdate=U,ct.type=B}function mt(v){Nt("WebGLRenderer: A WebGL context could not be created. Reason: ",v.statusMessage)}function re(v){let P=v.target;P.removeEventListener("dispose",re),Ie(P)}function Ie(v){hi(v),Pt.remove(v)}function hi(v){let P=Pt.get(v).programs;P!==void 0&&(P.forEach(function(z){Q.releaseProgram(z)}),v.isShaderMaterial&&Q.releaseShaderCache(v))}this.renderBufferDirect=function(v,P,z,U,B,ft){P===null&&(P=gn);let vt=B.isMesh&&B.matrixWorld.determinantAffine()<0,ut=Zm(v,P,z,U,B);pt.setMaterial(U,vt);let yt=z.index,Et=1;if(U.wireframe===!0){if(yt=F.getWireframeAttribute(z),yt===void 0)return;Et=2}let kt=z.drawRange,Zt=z.attributes.position,bt=kt.start*Et,Jt=(kt.start+kt.count)*Et;ft!==null&&(bt=Math.max(bt,ft.start*Et),Jt=Math.min(Jt,(ft.start+ft.count)*Et)),yt!==null?(bt=Math.max(bt,0),Jt=Math.min(Jt,yt.count)):Zt!=null&&(bt=Math.max(bt,0),Jt=Math.min(Jt,Zt.count));let Se=Jt-bt;if(Se<0||Se===1/0)return;lt.setup(B,U,ut,z,yt);let le,ae=W;if(yt!==null&&(le=y.get(yt),ae=ht,ae.setIndex(le)),B.isMesh)U.wireframe===!0?(pt.setLineWidth(U.wireframeLinewidth*xn()),ae.setMode(D.LINES)):ae.setMode(D.TRIANGLES);else if(B.isLine){let Be=U.linewidth;Be===void 0&&(Be=1),pt.setLineWidth(Be*xn()),B.isLineSegments?ae.setMode(D.LINES):B.isLineLoop?ae.setMode(D.LINE_LOOP):ae.setMode(D.LINE_STRIP)}else B.isPoints?ae.setMode(D.POINTS):B.isSprite&&ae.setMode(D.TRIANGLES);if(B.isBatchedMesh)if(ue.get("WEBGL_multi_draw"))ae.renderMultiDraw(B._multiDrawStarts,B._multiDrawCounts,B._multiDrawCount);else{let Be=B._multiDrawStarts,St=B._multiDrawCounts,He=B._multiDrawCount,ee=yt?y.get(yt).bytesPerElement:1,Ni=Pt.get(U).currentProgram.getUniforms();for(let ke=0;ke<He;ke++)Ni.setValue(D,"_gl_DrawID",ke),ae.render(Be[ke]/ee,St[ke])}else if(B.isInstancedMesh)ae.renderInstances(bt,Se,B.count);else if(z.isInstancedBufferGeometry){let Be=z._maxInstanceCount!==void 0?z._maxInstanceCount:1/0,St=Math.min(z.instanceCount,Be);ae.renderInstances(bt,Se,St)}else ae.render(bt,Se)};function Bu(v,P,z,U){V!==null&&v.isNodeMaterial&&V.setObject(U,v),Ee===!0&&Z.setState(v,z,!1),v.transparent===!0&&v.side===fn&&v.forceSinglePass===!1?(v.side=Ze,v.needsUpdate=!0,Ws(v,P,U),v.side=Gn,v.needsUpdate=!0,Ws(v,P,U),v.side=fn):Ws(v,P,U)}this.compile=function(v,P,z=null){z===null&&(z=v),V!==null&&V.renderStart(v,P,z),A=$.get(z),A.init(P),E.push(A),z.traverseVisible(function(B){B.isLight&&B.layers.test(P.layers)&&(A.pushLight(B),B.castShadow&&A.pushShadow(B))}),v!==z&&v.traverseVisible(function(B){B.isLight&&B.layers.test(P.layers)&&(A.pushLight(B),B.castShadow&&A.pushShadow(B))}),A.setupLights(),V!==null&&V.updateLights(A.state.lightsArray),je=this.localClippingEnabled,Ee=Z.init(this.clippingPlanes,je),Ee===!0&&Z.setGlobalState(this.clippingPlanes,P),V!==null&&ct.render(A.state.shadowsArray,z,P);let U=new Set;return v.traverse(function(B){if(!(B.isMesh||B.isPoints||B.isLine||B.isSprite))return;let ft=B.material;if(ft)if(Array.isArray(ft))for(let vt=0;vt<ft.length;vt++){let ut=ft[vt];Bu(ut,z,P,B),U.add(ut)}else Bu(ft,z,P,B),U.add(ft)}),A=E.pop(),V!==null&&V.renderEnd(),U},this.compileAsync=function(v,P,z=null){let U=this.compile(v,P,z);return new Promise(B=>{function ft(){if(U.forEach(function(vt){let yt=Pt.get(vt).currentProgram;(yt===void 0||yt.isReady())&&U.delete(vt)}),U.size===0){B(v);return}setTimeout(ft,10)}ue.get("KHR_parallel_shader_compile")!==null?ft():setTimeout(ft,10)})};let rc=null;function $m(v){rc&&rc(v)}function ku(){Di.stop()}function zu(){Di.start()}let Di=new Hf;Di.setAnimationLoop($m),typeof self<"u"&&Di.setContext(self),this.setAnimationLoop=function(v){rc=v,rt.setAnimationLoop(v),v===null?Di.stop():Di.start()},rt.addEventListener("sessionstart",ku),rt.addEventListener("sessionend",zu),this.render=function(v,P){if(P!==void 0&&P.isCamera!==!0){Nt("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(O===!0)return;V!==null&&V.renderStart(v,P);let z=rt.enabled===!0&&rt.isPresenting===!0,U=k!==null&&(st===null||z)&&k.begin(L,st);if(v.matrixWorldAutoUpdate===!0&&v.updateMatrixWorld(),P.parent===null&&P.matrixWorldAutoUpdate===!0&&P.updateMatrixWorld(),rt.enabled===!0&&rt.isPresenting===!0&&(k===null||k.isCompositing()===!1)&&(rt.cameraAutoUpdate===!0&&rt.updateCamera(P),P=rt.getCamera()),v.isScene===!0&&v.onBeforeRender(L,v,P,st),A=$.get(v,E.length),A.init(P),A.state.textureUnits=Ft.getTextureUnits(),E.push(A),fe.multiplyMatrices(P.projectionMatrix,P.matrixWorldInverse),P.isArrayCamera?Oe.setFromArrayCamera(P):Yt.setFromProjectionMatrix(fe,Mn,P.reversedDepth),je=this.localClippingEnabled,Ee=Z.init(this.clippingPlanes,je),R=dt.get(v,_.length),R.init(),_.push(R),this.info.render.frame++,rt.enabled===!0&&rt.isPresenting===!0){let vt=L.xr.getDepthSensingMesh();vt!==null&&oc(vt,P,-1/0,L.sortObjects)}oc(v,P,0,L.sortObjects),R.finish(),V!==null&&V.updateLights(A.state.lightsArray),L.sortObjects===!0&&R.sort(Vt,be),_n=rt.enabled===!1||rt.isPresenting===!1||rt.hasDepthSensing()===!1,_n&&C.addToRenderList(R,v),this.info.autoReset===!0&&this.info.reset(),Ee===!0&&Z.beginShadows();let B=A.state.shadowsArray;if(ct.render(B,v,P),Ee===!0&&Z.endShadows(),(U&&k.hasRenderPass())===!1){let vt=R.opaque,ut=R.transmissive;if(A.setupLights(),P.isArrayCamera){let yt=P.cameras;if(ut.length>0)for(let Et=0,kt=yt.length;Et<kt;Et++){let Zt=yt[Et];Gu(vt,ut,v,Zt)}_n&&C.render(v);for(let Et=0,kt=yt.length;Et<kt;Et++){let Zt=yt[Et];Vu(R,v,Zt,Zt.viewport)}}else ut.length>0&&Gu(vt,ut,v,P),_n&&C.render(v),Vu(R,v,P)}st!==null&&H===0&&(Ft.updateMultisampleRenderTarget(st),Ft.updateRenderTargetMipmap(st)),U&&k.end(L),v.isScene===!0&&v.onAfterRender(L,v,P),lt.resetDefaultState(),X=-1,tt=null,E.pop(),E.length>0?(A=E[E.length-1],Ft.setTextureUnits(A.state.textureUnits),Ee===!0&&Z.setGlobalState(L.clippingPlanes,A.state.camera)):A=null,_.pop(),_.length>0?R=_[_.length-1]:R=null,V!==null&&V.renderEnd()};function oc(v,P,z,U){if(v.visible===!1)return;if(v.layers.test(P.layers)){if(v.isGroup)z=v.renderOrder;else if(v.isLOD)v.autoUpdate===!0&&v.update(P);else if(v.isLight)A.pushLight(v),v.castShadow&&A.pushShadow(v);else if(v.isSprite){let vt=P.isArrayCamera?Oe:Yt;if(!v.frustumCulled||v.intersectsFrustum(vt)){U&&Pe.setFromMatrixPosition(v.matrixWorld).applyMatrix4(fe);let ut=it.update(v),yt=v.material;yt.visible&&R.push(v,ut,yt,z,Pe.z,null,P)}}else if(v.isMesh||v.isLine||v.isPoints){let vt=P.isArrayCamera?Oe:Yt;if(!v.frustumCulled||v.intersectsFrustum(vt)){let ut=it.update(v),yt=v.material;if(U&&(v.boundingSphere!==void 0?(v.boundingSphere===null&&v.computeBoundingSphere(),Pe.copy(v.boundingSphere.center)):(ut.boundingSphere===null&&ut.computeBoundingSphere(),Pe.copy(ut.boundingSphere.center)),Pe.applyMatrix4(v.matrixWorld).applyMatrix4(fe)),Array.isArray(yt)){let Et=ut.groups;for(let kt=0,Zt=Et.length;kt<Zt;kt++){let bt=Et[kt],Jt=yt[bt.materialIndex];Jt&&Jt.visible&&R.push(v,ut,Jt,z,Pe.z,bt,P)}}else yt.visible&&R.push(v,ut,yt,z,Pe.z,null,P)}}}let ft=v.children;for(let vt=0,ut=ft.length;vt<ut;vt++)oc(ft[vt],P,z,U)}function Vu(v,P,z,U){let{opaque:B,transmissive:ft,transparent:vt}=v;A.setupLightsView(z),Ee===!0&&Z.setGlobalState(L.clippingPlanes,z),U&&pt.viewport(et.copy(U)),B.length>0&&jr(B,P,z),ft.length>0&&jr(ft,P,z),vt.length>0&&jr(vt,P,z),pt.buffers.depth.setTest(!0),pt.buffers.depth.setMask(!0),pt.buffers.color.setMask(!0),pt.setPolygonOffset(!1)}function Gu(v,P,z,U){if((z.isScene===!0?z.overrideMaterial:null)!==null)return;if(A.state.transmissionRenderTarget[U.id]===void 0){let bt=ue.has("EXT_color_buffer_half_float")||ue.has("EXT_color_buffer_float");A.state.transmissionRenderTarget[U.id]=new cn(1,1,{generateMipmaps:!0,type:bt?Pn:Je,minFilter:si,samples:Math.max(4,de.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:Kt.workingColorSpace})}let ft=A.state.transmissionRenderTarget[U.id],vt=U.viewport||et;ft.setSize(vt.z*L.transmissionResolutionScale,vt.w*L.transmissionResolutionScale);let ut=L.getRenderTarget(),yt=L.getActiveCubeFace(),Et=L.getActiveMipmapLevel();L.setRenderTarget(ft),L.getClearColor(J),_t=L.getClearAlpha(),_t<1&&L.setClearColor(16777215,.5),L.clear(),_n&&C.render(z);let kt=L.toneMapping;L.toneMapping=Hn;let Zt=U.viewport;if(U.viewport!==void 0&&(U.viewport=void 0),A.setupLightsView(U),Ee===!0&&Z.setGlobalState(L.clippingPlanes,U),jr(v,z,U),Ft.updateMultisampleRenderTarget(ft),Ft.updateRenderTargetMipmap(ft),ue.has("WEBGL_multisampled_render_to_texture")===!1){let bt=!1;for(let Jt=0,Se=P.length;Jt<Se;Jt++){let le=P[Jt],{object:ae,geometry:Be,material:St,group:He}=le;if(St.side===fn&&ae.layers.test(U.layers)){let ee=St.side;St.side=Ze,St.needsUpdate=!0,Hu(ae,z,U,Be,St,He),St.side=ee,St.needsUpdate=!0,bt=!0}}bt===!0&&(Ft.updateMultisampleRenderTarget(ft),Ft.updateRenderTargetMipmap(ft))}L.setRenderTarget(ut,yt,Et),L.setClearColor(J,_t),Zt!==void 0&&(U.viewport=Zt),L.toneMapping=kt}function jr(v,P,z){let U=P.isScene===!0?P.overrideMaterial:null;for(let B=0,ft=v.length;B<ft;B++){let vt=v[B],{object:ut,geometry:yt,group:Et}=vt,kt=vt.material;kt.allowOverride===!0&&U!==null&&(kt=U),ut.layers.test(z.layers)&&Hu(ut,P,z,yt,kt,Et)}}function Hu(v,P,z,U,B,ft){V!==null&&B.isNodeMaterial&&V.setObject(v,B),v.onBeforeRender(L,P,z,U,B,ft),v.modelViewMatrix.multiplyMatrices(z.matrixWorldInverse,v.matrixWorld),v.normalMatrix.getNormalMatrix(v.modelViewMatrix),B.onBeforeRender(L,P,z,U,v,ft),B.transparent===!0&&B.side===fn&&B.forceSinglePass===!1?(B.side=Ze,B.needsUpdate=!0,L.renderBufferDirect(z,P,U,B,v,ft),B.side=Gn,B.needsUpdate=!0,L.renderBufferDirect(z,P,U,B,v,ft),B.side=fn):L.renderBufferDirect(z,P,U,B,v,ft),v.onAfterRender(L,P,z,U,B,ft)}function Wu(v){let P=0;for(let z of v)z.texture!==null&&P++;return P}function Ws(v,P,z){P.isScene!==!0&&(P=gn);let U=Pt.get(v),B=A.state.lights,ft=A.state.shadowsArray,vt=B.state.version,ut=Q.getParameters(v,B.state,ft,P,z,A.state.lightProbeGridArray),yt=Q.getProgramCacheKey(ut),Et=U.programs;U.environment=v.isMeshStandardMaterial||v.isMeshLambertMaterial||v.isMeshPhongMaterial?P.environment:null,U.fog=P.fog;let kt=v.isMeshStandardMaterial||v.isMeshLambertMaterial&&!v.envMap||v.isMeshPhongMaterial&&!v.envMap;U.envMap=T.get(v.envMap||U.environment,kt),U.envMapRotation=U.environment!==null&&v.envMap===null?P.environmentRotation:v.envMapRotation,Et===void 0&&(v.addEventListener("dispose",re),Et=new Map,U.programs=Et,U.programVariants=new Map);let Zt=Et.get(yt);if(Zt!==void 0){if(U.currentProgram===Zt&&U.lightsStateVersion===vt)return qu(v,ut),Zt}else ut.uniforms=Q.getUniforms(v),V!==null&&v.isNodeMaterial&&V.build(v,z,ut),v.onBeforeCompile(ut,L),Zt=Q.acquireProgram(ut,yt),Et.set(yt,Zt),U.uniforms=ut.uniforms;let bt=U.uniforms;return(!v.isShaderMaterial&&!v.isRawShaderMaterial||v.clipping===!0)&&(bt.clippingPlanes=Z.uniform),qu(v,ut),U.needsLights=Km(v),U.lightsStateVersion=vt,U.needsLights&&(bt.ambientLightColor.value=B.state.ambient,bt.lightProbe.value=B.state.probe,bt.sunLights.value=B.state.sun,bt.sunLightShadows.value=B.state.sunShadow,bt.directionalLights.value=B.state.directional,bt.directionalLightShadows.value=B.state.directionalShadow,bt.spotLights.value=B.state.spot,bt.spotLightShadows.value=B.state.spotShadow,bt.rectAreaLights.value=B.state.rectArea,bt.ltc_1.value=B.state.rectAreaLTC1,bt.ltc_2.value=B.state.rectAreaLTC2,bt.pointLights.value=B.state.point,bt.pointLightShadows.value=B.state.pointShadow,bt.hemisphereLights.value=B.state.hemi,bt.sunShadowMatrix.value=B.state.sunShadowMatrix,bt.sunShadowCascade.value=B.state.sunShadowCascade,bt.directionalShadowMatrix.value=B.state.directionalShadowMatrix,bt.spotLightMatrix.value=B.state.spotLightMatrix,bt.spotLightMap.value=B.state.spotLightMap,bt.pointShadowMatrix.value=B.state.pointShadowMatrix),U.numLightProbeGrids=Wu(A.state.lightProbeGridArray),U.currentProgram=Zt,U.uniformsList=null,Zt}function Ym(v,P,z,U,B){let ft=Pt.get(v),vt=ft.currentProgram.id+","+U+","+B,ut=ft.programVariants.get(vt);return ut===void 0?(ut=Ws(v,P,z),ft.programVariants.set(vt,ut)):(ft.currentProgram=ut,ft.uniformsList=null,ft.outputColorSpace=U,ft.toneMapping=B),ut}function Xu(v){if(v.uniformsList===null){let P=v.currentProgram.getUniforms();v.uniformsList=Rs.seqWithValue(P.seq,v.uniforms)}return v.uniformsList}function qu(v,P){let z=Pt.get(v);z.outputColorSpace=P.outputColorSpace,z.batching=P.batching,z.batchingColor=P.batchingColor,z.instancing=P.instancing,z.instancingColor=P.instancingColor,z.instancingMorph=P.instancingMorph,z.skinning=P.skinning,z.morphTargets=P.morphTargets,z.morphNormals=P.morphNormals,z.morphColors=P.morphColors,z.morphTargetsCount=P.morphTargetsCount,z.numClippingPlanes=P.numClippingPlanes,z.numIntersection=P.numClipIntersection,z.vertexAlphas=P.vertexAlphas,z.vertexTangents=P.vertexTangents,z.toneMapping=P.toneMapping}function Zm(v,P,z,U,B){P.isScene!==!0&&(P=gn),Ft.resetTextureUnits();let ft=P.fog,vt=U.isMeshStandardMaterial||U.isMeshLambertMaterial||U.isMeshPhongMaterial?P.environment:null,ut=st===null?L.outputColorSpace:st.isXRRenderTarget===!0?st.texture.colorSpace:Kt.workingColorSpace,yt=U.isMeshStandardMaterial||U.isMeshLambertMaterial&&!U.envMap||U.isMeshPhongMaterial&&!U.envMap,Et=T.get(U.envMap||vt,yt),kt=U.vertexColors===!0&&!!z.attributes.color&&z.attributes.color.itemSize===4,Zt=!!z.attributes.tangent&&(!!U.normalMap||U.anisotropy>0),bt=!!z.morphAttributes.position,Jt=!!z.morphAttributes.normal,Se=!!z.morphAttributes.color,le=Hn;U.toneMapped&&(st===null||st.isXRRenderTarget===!0)&&(le=L.toneMapping);let ae=z.morphAttributes.position||z.morphAttributes.normal||z.morphAttributes.color,Be=ae!==void 0?ae.length:0,St=Pt.get(U),He=A.state.lights;if(Ee===!0&&(je===!0||v!==tt)){let pe=v===tt&&U.id===X;Z.setState(U,v,pe)}let ee=!1,Ni=!1;U.version===St.__version?St.needsLights&&St.lightsStateVersion!==He.state.version||B.isBatchedMesh&&St.batching===!1||!B.isBatchedMesh&&St.batching===!0||B.isBatchedMesh&&St.batchingColor===!0&&B._colorsTexture===null||B.isBatchedMesh&&St.batchingColor===!1&&B._colorsTexture!==null||B.isInstancedMesh&&St.instancing===!1||!B.isInstancedMesh&&St.instancing===!0||B.isSkinnedMesh&&St.skinning===!1||!B.isSkinnedMesh&&St.skinning===!0||B.isInstancedMesh&&St.instancingColor===!0&&B.instanceColor===null||B.isInstancedMesh&&St.instancingColor===!1&&B.instanceColor!==null||B.isInstancedMesh&&St.instancingMorph===!0&&B.morphTexture===null||B.isInstancedMesh&&St.instancingMorph===!1&&B.morphTexture!==null||St.envMap!==Et||U.fog===!0&&St.fog!==ft||St.numClippingPlanes!==void 0&&(St.numClippingPlanes!==Z.numPlanes||St.numIntersection!==Z.numIntersection)||St.vertexAlphas!==kt||St.vertexTangents!==Zt||St.morphTargets!==bt||St.morphNormals!==Jt||St.morphColors!==Se||St.morphTargetsCount!==Be||St.numLightProbeGrids!==Wu(A.state.lightProbeGridArray)?ee=!0:(St.outputColorSpace!==ut||St.toneMapping!==le)&&(Ni=!0):(ee=!0,St.__version=U.version);let ke=St.currentProgram;(ee===!0||Ni===!0)&&(ke=Ni===!0?Ym(U,P,B,ut,le):Ws(U,P,B),V&&U.isNodeMaterial&&V.onUpdateProgram(U,ke,St));let Qr=!1,ui=!1,Oi=!1,jt=ke.getUniforms(),Ue=St.uniforms;if(pt.useProgram(ke.program)&&(Qr=!0,ui=!0,Oi=!0),U.id!==X&&(X=U.id,ui=!0),Qr||tt!==v){pt.buffers.depth.getReversed()&&v.reversedDepth!==!0&&(v._reversedDepth=!0,v.updateProjectionMatrix()),jt.setValue(D,"projectionMatrix",v.projectionMatrix),jt.setValue(D,"viewMatrix",v.matrixWorldInverse);let Le=jt.map.cameraPosition;Le!==void 0&&Le.setValue(D,On.setFromMatrixPosition(v.matrixWorld)),de.logarithmicDepthBuffer&&jt.setValue(D,"logDepthBufFC",2/(Math.log(v.far+1)/Math.LN2)),(U.isMeshPhongMaterial||U.isMeshToonMaterial||U.isMeshLambertMaterial||U.isMeshBasicMaterial||U.isMeshStandardMaterial||U.isShaderMaterial)&&jt.setValue(D,"isOrthographic",v.isOrthographicCamera===!0),tt!==v&&(tt=v,ui=!0,Oi=!0)}if(St.needsLights&&(He.state.sunShadowMap.length>0&&jt.setValue(D,"sunShadowMap",He.state.sunShadowMap,Ft),He.state.directionalShadowMap.length>0&&jt.setValue(D,"directionalShadowMap",He.state.directionalShadowMap,Ft),He.state.spotShadowMap.length>0&&jt.setValue(D,"spotShadowMap",He.state.spotShadowMap,Ft),He.state.pointShadowMap.length>0&&jt.setValue(D,"pointShadowMap",He.state.pointShadowMap,Ft)),B.isSkinnedMesh){jt.setOptional(D,B,"bindMatrix"),jt.setOptional(D,B,"bindMatrixInverse");let pe=B.skeleton;pe&&(pe.boneTexture===null&&pe.computeBoneTexture(),jt.setValue(D,"boneTexture",pe.boneTexture,Ft))}B.isBatchedMesh&&(jt.setOptional(D,B,"batchingTexture"),jt.setValue(D,"batchingTexture",B._matricesTexture,Ft),jt.setOptional(D,B,"batchingIdTexture"),jt.setValue(D,"batchingIdTexture",B._indirectTexture,Ft),jt.setOptional(D,B,"batchingColorTexture"),B._colorsTexture!==null&&jt.setValue(D,"batchingColorTexture",B._colorsTexture,Ft));let Sn=z.morphAttributes;if((Sn.position!==void 0||Sn.normal!==void 0||Sn.color!==void 0)&&K.update(B,z,ke),(ui||St.receiveShadow!==B.receiveShadow)&&(St.receiveShadow=B.receiveShadow,jt.setValue(D,"receiveShadow",B.receiveShadow)),(U.isMeshStandardMaterial||U.isMeshLambertMaterial||U.isMeshPhongMaterial)&&U.envMap===null&&P.environment!==null&&(Ue.envMapIntensity.value=P.environmentIntensity),Ue.dfgLUT!==void 0&&(Ue.dfgLUT.value=eM()),ui){if(jt.setValue(D,"toneMappingExposure",L.toneMappingExposure),St.needsLights&&Jm(Ue,Oi),ft&&U.fog===!0&&at.refreshFogUniforms(Ue,ft),at.refreshMaterialUniforms(Ue,U,xt,Ct,A.state.transmissionRenderTarget[v.id]),St.needsLights&&St.numLightProbeGrids>0){let pe=b,Le=0;for(let Zn of A.state.lightProbeGridArray)Zn.texture!==null&&(pe.textures[Le]=Zn.texture,pe.min[Le]=Zn.boundingBox.min,pe.max[Le]=Zn.boundingBox.max,pe.resolution[Le]=Zn.resolution,Le++);for(let Zn in pe)pe[Zn].length=Le;Ue.probesSH.value=pe.textures,Ue.probesMin.value=pe.min,Ue.probesMax.value=pe.max,Ue.probesResolution.value=pe.resolution}Rs.upload(D,Xu(St),Ue,Ft)}if(U.isShaderMaterial&&U.uniformsNeedUpdate===!0&&(Rs.upload(D,Xu(St),Ue,Ft),U.uniformsNeedUpdate=!1),U.isSpriteMaterial&&jt.setValue(D,"center",B.center),jt.setValue(D,"modelViewMatrix",B.modelViewMatrix),jt.setValue(D,"normalMatrix",B.normalMatrix),jt.setValue(D,"modelMatrix",B.matrixWorld),U.uniformsGroups!==void 0){let pe=U.uniformsGroups;for(let Le=0,Zn=pe.length;Le<Zn;Le++){let Yu=pe[Le];At.update(Yu,ke),At.bind(Yu,ke)}}return ke}function Jm(v,P){v.ambientLightColor.needsUpdate=P,v.lightProbe.needsUpdate=P,v.sunLights.needsUpdate=P,v.sunLightShadows.needsUpdate=P,v.directionalLights.needsUpdate=P,v.directionalLightShadows.needsUpdate=P,v.pointLights.needsUpdate=P,v.pointLightShadows.needsUpdate=P,v.spotLights.needsUpdate=P,v.spotLightShadows.needsUpdate=P,v.rectAreaLights.needsUpdate=P,v.hemisphereLights.needsUpdate=P}function Km(v){return v.isMeshLambertMaterial||v.isMeshToonMaterial||v.isMeshPhongMaterial||v.isMeshStandardMaterial||v.isShadowMaterial||v.isShaderMaterial&&v.lights===!0}this.getActiveCubeFace=function(){return j},this.getActiveMipmapLevel=function(){return H},this.getRenderTarget=function(){return st},this.setRenderTargetTextures=function(v,P,z){let U=Pt.get(v);U.__autoAllocateDepthBuffer=v.resolveDepthBuffer===!1,U.__autoAllocateDepthBuffer===!1&&(U.__useRenderToTexture=!1),Pt.get(v.texture).__webglTexture=P,Pt.get(v.depthTexture).__webglTexture=U.__autoAllocateDepthBuffer?void 0:z,U.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(v,P){let z=Pt.get(v);z.__webglFramebuffer=P,z.__useDefaultFramebuffer=P===void 0},this.setRenderTarget=function(v,P=0,z=0){st=v,j=P,H=z;let U=null,B=!1,ft=!1;if(v){let ut=Pt.get(v);if(ut.__useDefaultFramebuffer!==void 0){pt.bindFramebuffer(D.FRAMEBUFFER,ut.__webglFramebuffer),et.copy(v.viewport),wt.copy(v.scissor),Bt=v.scissorTest,pt.viewport(et),pt.scissor(wt),pt.setScissorTest(Bt),X=-1;return}else if(ut.__webglFramebuffer===void 0)Ft.setupRenderTarget(v);else if(ut.__hasExternalTextures)Ft.rebindTextures(v,Pt.get(v.texture).__webglTexture,Pt.get(v.depthTexture).__webglTexture);else if(v.depthBuffer){let kt=v.depthTexture;if(ut.__boundDepthTexture!==kt){if(kt!==null&&Pt.has(kt)&&(v.width!==kt.image.width||v.height!==kt.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Ft.setupDepthRenderbuffer(v)}}let yt=v.texture;(yt.isData3DTexture||yt.isDataArrayTexture||yt.isCompressedArrayTexture)&&(ft=!0);let Et=Pt.get(v).__webglFramebuffer;v.isWebGLCubeRenderTarget?(Array.isArray(Et[P])?U=Et[P][z]:U=Et[P],B=!0):v.samples>0&&Ft.useMultisampledRTT(v)===!1?U=Pt.get(v).__webglMultisampledFramebuffer:Array.isArray(Et)?U=Et[z]:U=Et,et.copy(v.viewport),wt.copy(v.scissor),Bt=v.scissorTest}else et.copy(Dt).multiplyScalar(xt).floor(),wt.copy(se).multiplyScalar(xt).floor(),Bt=oe;if(z!==0&&(U=Y),pt.bindFramebuffer(D.FRAMEBUFFER,U)&&pt.drawBuffers(v,U),pt.viewport(et),pt.scissor(wt),pt.setScissorTest(Bt),B){let ut=Pt.get(v.texture);D.framebufferTexture2D(D.FRAMEBUFFER,D.COLOR_ATTACHMENT0,D.TEXTURE_CUBE_MAP_POSITIVE_X+P,ut.__webglTexture,z)}else if(ft){let ut=P;for(let yt=0;yt<v.textures.length;yt++){let Et=Pt.get(v.textures[yt]);D.framebufferTextureLayer(D.FRAMEBUFFER,D.COLOR_ATTACHMENT0+yt,Et.__webglTexture,z,ut)}}else if(v!==null&&z!==0){let ut=Pt.get(v.texture);D.framebufferTexture2D(D.FRAMEBUFFER,D.COLOR_ATTACHMENT0,D.TEXTURE_2D,ut.__webglTexture,z)}X=-1};function $u(v){let P=Pt.get(v);return(P.__readFormat!==v.format||P.__readType!==v.type)&&(P.__readFormat=v.format,P.__readType=v.type,P.__formatReadable=de.textureFormatReadable(v.format),P.__typeReadable=de.textureTypeReadable(v.type)),P}this.readRenderTargetPixels=function(v,P,z,U,B,ft,vt,ut=0){if(!(v&&v.isWebGLRenderTarget)){Nt("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let yt=Pt.get(v).__webglFramebuffer;if(v.isWebGLCubeRenderTarget&&vt!==void 0&&(yt=yt[vt],Array.isArray(yt)&&(yt=yt[0])),yt){pt.bindFramebuffer(D.FRAMEBUFFER,yt);try{let Et=v.textures[ut],kt=Et.format,Zt=Et.type;v.textures.length>1&&D.readBuffer(D.COLOR_ATTACHMENT0+ut);let bt=$u(Et);if(bt.__formatReadable===!1){Nt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(bt.__typeReadable===!1){Nt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}P>=0&&P<=v.width-U&&z>=0&&z<=v.height-B&&D.readPixels(P,z,U,B,ot.convert(kt),ot.convert(Zt),ft)}finally{let Et=st!==null?Pt.get(st).__webglFramebuffer:null;pt.bindFramebuffer(D.FRAMEBUFFER,Et)}}},this.readRenderTargetPixelsAsync=async function(v,P,z,U,B,ft,vt,ut=0){if(!(v&&v.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let yt=Pt.get(v).__webglFramebuffer;if(v.isWebGLCubeRenderTarget&&vt!==void 0&&(yt=yt[vt],Array.isArray(yt)&&(yt=yt[0])),yt)if(P>=0&&P<=v.width-U&&z>=0&&z<=v.height-B){pt.bindFramebuffer(D.FRAMEBUFFER,yt);let Et=v.textures[ut],kt=Et.format,Zt=Et.type;v.textures.length>1&&D.readBuffer(D.COLOR_ATTACHMENT0+ut);let bt=$u(Et);if(bt.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(bt.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let Jt=D.createBuffer();D.bindBuffer(D.PIXEL_PACK_BUFFER,Jt),D.bufferData(D.PIXEL_PACK_BUFFER,ft.byteLength,D.STREAM_READ),D.readPixels(P,z,U,B,ot.convert(kt),ot.convert(Zt),0),D.bindBuffer(D.PIXEL_PACK_BUFFER,null);let Se=st!==null?Pt.get(st).__webglFramebuffer:null;pt.bindFramebuffer(D.FRAMEBUFFER,Se);let le=D.fenceSync(D.SYNC_GPU_COMMANDS_COMPLETE,0);return D.flush(),await hf(D,le,4),D.bindBuffer(D.PIXEL_PACK_BUFFER,Jt),D.getBufferSubData(D.PIXEL_PACK_BUFFER,0,ft),D.bindBuffer(D.PIXEL_PACK_BUFFER,null),D.deleteBuffer(Jt),D.deleteSync(le),ft}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(v,P=null,z=0){let U=Math.pow(2,-z),B=Math.floor(v.image.width*U),ft=Math.floor(v.image.height*U),vt=P!==null?P.x:0,ut=P!==null?P.y:0;Ft.setTexture2D(v,0),D.copyTexSubImage2D(D.TEXTURE_2D,z,0,0,vt,ut,B,ft),pt.unbindTexture()},this.copyTextureToTexture=function(v,P,z=null,U=null,B=0,ft=0){let vt,ut,yt,Et,kt,Zt,bt,Jt,Se,le=v.isCompressedTexture?v.mipmaps[ft]:v.image;if(z!==null)vt=z.max.x-z.min.x,ut=z.max.y-z.min.y,yt=z.isBox3?z.max.z-z.min.z:1,Et=z.min.x,kt=z.min.y,Zt=z.isBox3?z.min.z:0;else{let jt=Math.pow(2,-B);vt=Math.floor(le.width*jt),ut=Math.floor(le.height*jt),v.isDataArrayTexture?yt=le.depth:v.isData3DTexture?yt=Math.floor(le.depth*jt):yt=1,Et=0,kt=0,Zt=0}U!==null?(bt=U.x,Jt=U.y,Se=U.z):(bt=0,Jt=0,Se=0);let ae=ot.convert(P.format),Be=ot.convert(P.type),St;P.isData3DTexture?(Ft.setTexture3D(P,0),St=D.TEXTURE_3D):P.isDataArrayTexture||P.isCompressedArrayTexture?(Ft.setTexture2DArray(P,0),St=D.TEXTURE_2D_ARRAY):(Ft.setTexture2D(P,0),St=D.TEXTURE_2D),pt.activeTexture(D.TEXTURE0),pt.pixelStorei(D.UNPACK_FLIP_Y_WEBGL,P.flipY),pt.pixelStorei(D.UNPACK_PREMULTIPLY_ALPHA_WEBGL,P.premultiplyAlpha),pt.pixelStorei(D.UNPACK_ALIGNMENT,P.unpackAlignment);let He=pt.getParameter(D.UNPACK_ROW_LENGTH),ee=pt.getParameter(D.UNPACK_IMAGE_HEIGHT),Ni=pt.getParameter(D.UNPACK_SKIP_PIXELS),ke=pt.getParameter(D.UNPACK_SKIP_ROWS),Qr=pt.getParameter(D.UNPACK_SKIP_IMAGES);pt.pixelStorei(D.UNPACK_ROW_LENGTH,le.width),pt.pixelStorei(D.UNPACK_IMAGE_HEIGHT,le.height),pt.pixelStorei(D.UNPACK_SKIP_PIXELS,Et),pt.pixelStorei(D.UNPACK_SKIP_ROWS,kt),pt.pixelStorei(D.UNPACK_SKIP_IMAGES,Zt);let ui=v.isDataArrayTexture||v.isData3DTexture,Oi=P.isDataArrayTexture||P.isData3DTexture;if(v.isDepthTexture){let jt=Pt.get(v),Ue=Pt.get(P),Sn=Pt.get(jt.__renderTarget),pe=Pt.get(Ue.__renderTarget);pt.bindFramebuffer(D.READ_FRAMEBUFFER,Sn.__webglFramebuffer),pt.bindFramebuffer(D.DRAW_FRAMEBUFFER,pe.__webglFramebuffer);for(let Le=0;Le<yt;Le++)ui&&(D.framebufferTextureLayer(D.READ_FRAMEBUFFER,D.COLOR_ATTACHMENT0,Pt.get(v).__webglTexture,B,Zt+Le),D.framebufferTextureLayer(D.DRAW_FRAMEBUFFER,D.COLOR_ATTACHMENT0,Pt.get(P).__webglTexture,ft,Se+Le)),D.blitFramebuffer(Et,kt,Et+vt,kt+ut,bt,Jt,bt+vt,Jt+ut,D.DEPTH_BUFFER_BIT,D.NEAREST);pt.bindFramebuffer(D.READ_FRAMEBUFFER,null),pt.bindFramebuffer(D.DRAW_FRAMEBUFFER,null)}else if(B!==0||v.isRenderTargetTexture||Pt.has(v)){let jt=Pt.get(v),Ue=Pt.get(P);pt.bindFramebuffer(D.READ_FRAMEBUFFER,I),pt.bindFramebuffer(D.DRAW_FRAMEBUFFER,q);for(let Sn=0;Sn<yt;Sn++)ui?D.framebufferTextureLayer(D.READ_FRAMEBUFFER,D.COLOR_ATTACHMENT0,jt.__webglTexture,B,Zt+Sn):D.framebufferTexture2D(D.READ_FRAMEBUFFER,D.COLOR_ATTACHMENT0,D.TEXTURE_2D,jt.__webglTexture,B),Oi?D.framebufferTextureLayer(D.DRAW_FRAMEBUFFER,D.COLOR_ATTACHMENT0,Ue.__webglTexture,ft,Se+Sn):D.framebufferTexture2D(D.DRAW_FRAMEBUFFER,D.COLOR_ATTACHMENT0,D.TEXTURE_2D,Ue.__webglTexture,ft),B!==0?D.blitFramebuffer(Et,kt,Et+vt,kt+ut,bt,Jt,bt+vt,Jt+ut,D.COLOR_BUFFER_BIT,D.NEAREST):Oi?D.copyTexSubImage3D(St,ft,bt,Jt,Se+Sn,Et,kt,vt,ut):D.copyTexSubImage2D(St,ft,bt,Jt,Et,kt,vt,ut);pt.bindFramebuffer(D.READ_FRAMEBUFFER,null),pt.bindFramebuffer(D.DRAW_FRAMEBUFFER,null)}else Oi?v.isDataTexture||v.isData3DTexture?D.texSubImage3D(St,ft,bt,Jt,Se,vt,ut,yt,ae,Be,le.data):P.isCompressedArrayTexture?D.compressedTexSubImage3D(St,ft,bt,Jt,Se,vt,ut,yt,ae,le.data):D.texSubImage3D(St,ft,bt,Jt,Se,vt,ut,yt,ae,Be,le):v.isDataTexture?D.texSubImage2D(D.TEXTURE_2D,ft,bt,Jt,vt,ut,ae,Be,le.data):v.isCompressedTexture?D.compressedTexSubImage2D(D.TEXTURE_2D,ft,bt,Jt,le.width,le.height,ae,le.data):D.texSubImage2D(D.TEXTURE_2D,ft,bt,Jt,vt,ut,ae,Be,le);pt.pixelStorei(D.UNPACK_ROW_LENGTH,He),pt.pixelStorei(D.UNPACK_IMAGE_HEIGHT,ee),pt.pixelStorei(D.UNPACK_SKIP_PIXELS,Ni),pt.pixelStorei(D.UNPACK_SKIP_ROWS,ke),pt.pixelStorei(D.UNPACK_SKIP_IMAGES,Qr),ft===0&&P.generateMipmaps===!0&&P.mipmapsAutoUpdate===!0&&D.generateMipmap(St),pt.unbindTexture()},this.initRenderTarget=function(v){Pt.get(v).__webglFramebuffer===void 0&&Ft.setupRenderTarget(v)},this.initTexture=function(v){v.isCubeTexture?Ft.setTextureCube(v,0):v.isData3DTexture?Ft.setTexture3D(v,0):v.isDataArrayTexture||v.isCompressedArrayTexture?Ft.setTexture2DArray(v,0):Ft.setTexture2D(v,0),pt.unbindTexture()},this.resetState=function(){j=0,H=0,st=null,pt.reset(),lt.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return Mn}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;let e=this.getContext();e.drawingBufferColorSpace=Kt._getDrawingBufferColorSpace(t),e.unpackColorSpace=Kt._getUnpackColorSpace()}};var G=i=>new N(...i);function $t(i,t,e,n=0){let s=G(t).normalize(),r=G(e).addScaledVector(s,-s.dot(G(e))).normalize(),o=s.clone().cross(r);return new Qt().makeBasis(r,o,s).multiply(new Qt().makeRotationZ(n)).setPosition(G(i))}var Ps=({place:i,direction:t,bands:e})=>[e[0][0],e.at(-1)[1]].map(n=>G(i).addScaledVector(G(t),n));function In(i){let t=G(i),e=Math.abs(t.x)<.9?new N(1,0,0):new N(0,1,0);return e.addScaledVector(t,-t.dot(e)).normalize()}function tp(i,t,e,n){let[s,r,o,a]=[i,t,e,n].map(G),l=o.clone().sub(s),c=r.dot(a),h=1-c*c,u=h<1e-9?l.dot(r):(l.dot(r)-c*l.dot(a))/h;return s.addScaledVector(r,u)}var ve=(i,t)=>G(t).sub(G(i.point)).dot(G(i.direction)),Me=(i,t)=>G(i.point).addScaledVector(G(i.direction),t),qn=(i,t)=>Me(i,ve(i,t)).distanceTo(G(t)),he=(i,t)=>Math.abs(G(i).dot(G(t)))>1-1e-6;function Ka(i,t,e,n){let[s,r]=[i.bodies[t],i.bodies[e]];return he(s.direction,r.direction)&&qn(s,r.point)<1e-6*n}var ep=16,nM=.6,iM=1.3,sM=.14,Dh=[.8,12],np=()=>new N;function Yi(i,t=np){let e=i.dials.map(({body:s,centre:r,normal:o,radius:a})=>({at:G(r).add(t(s)),direction:o,radius:1.08*a,body:s}));return[...i.wheels.flatMap(s=>rM(li(s),s,t(s.body)).flatMap(r=>ip(i,s,r,t))),...e]}var ja=(i,t)=>ip(i,t,{at:G(t.centre),direction:t.direction,radius:li(t),body:t.body},np),Dr=({root:i,radius:t,module:e})=>Math.max(i,t)+2*Math.max(e,.02*t),li=i=>i.kind==="ring"?Dr(i):Math.max(i.tip,i.radius);function rM(i,{body:t,centre:e,direction:n,thickness:s,cone:r},o){let a=r?1.1*s:.6*s;return[a,-a].map(l=>({at:G(e).add(o).addScaledVector(G(n),l),direction:n,radius:i,body:t}))}function ip(i,t,e,n){let s=i.bodies[t.body].parent??0,r={...i.bodies[s],point:G(i.bodies[s].point).add(n(s))};if(r.parent===null)return[e];let o=Me(r,ve(r,e.at)),a=G(e.direction).dot(G(r.direction)),[l,c]=[Math.abs(a)*e.radius,Math.sqrt(Math.max(0,1-a*a))*e.radius],h=o.distanceTo(e.at)+l;return[c,-c].map(u=>({at:o.clone().addScaledVector(G(r.direction),u),direction:r.direction,radius:h,body:t.body}))}function Ln({at:i,direction:t,radius:e}){let n=In(t),s=G(t).cross(n);return Array.from({length:ep},(r,o)=>{let a=2*Math.PI*o/ep;return i.clone().addScaledVector(n,e*Math.cos(a)).addScaledVector(s,e*Math.sin(a))})}function Qa(i,t,e=[]){let n=new Rn().setFromPoints([...t.flatMap(Ln),...e]);if(n.isEmpty())for(let{point:s}of i.bodies)n.expandByPoint(G(s).addScalar(10)).expandByPoint(G(s).subScalar(10));return n.getBoundingSphere(new un)}function tl(i,t){let e=(n,s)=>t.skewed[s]?n:t.apart(n,t.height(n));return Yi(i,n=>t.shift(n)).flatMap(n=>Ln(n).map(s=>e(s,n.body)))}function el(i,t,e){if(!t.length)return Dh[0];let{radius:n}=new Rn().setFromPoints(t).getBoundingSphere(new un),s=t.map(h=>h.dot(e)),r=Math.max(...s)-Math.min(...s)||1e-9,o=Math.sqrt(Math.max(4*n*n-r*r,r*r)),a=i.wheels.filter(({direction:h})=>he(h,e.toArray())).map(({centre:h,thickness:u})=>[G(h).dot(e),u]);a.sort(([h],[u])=>h-u);let l=a.filter(([h,u],d)=>d===0||h-a[d-1][0]>.5*u).length,c=Math.max(nM,Math.min(iM,sM*(l+2)))*o;return Math.max(Dh[0],Math.min(Dh[1],c/r-1))}function nl(i){let t=i.parts.find(({kind:r})=>r==="frame"),e=new Map;for(let{direction:r,radius:o}of i.wheels){let a=r.map(l=>Math.abs(l).toFixed(4)).join(" ");e.set(a,{direction:r,size:(e.get(a)?.size??0)+o})}let n=[...e.values()].sort((r,o)=>o.size-r.size)[0],s=G(t?.direction??n?.direction??[0,0,1]);return s.dot(new N(0,0,1))<0?s.negate():s}var Pi=["#0072b2","#a05a00","#bb2288","#227755","#440088","#772200","#0000ee","#dd2266","#005544","#442244"],il="#b3261e",sp="#655f52",Nr="#c9c3b4";var en=Pi,sl=il,Nh=Pi[0],Oh=Pi[6],$n=["#cfa652","#d9b56b","#c49848","#d2ac62","#c9a047","#dcbb78"],Tt={arbor:"#9aa1ab",arm:"#b07f52",plate:"#a98a55",pipe:"#b98f4e",pin:"#5b636f",slot:"#828a96",face:"#ece5d3",silver:"#dfe2e6",bezel:"#b08d4c",mark:"#2b261d"},rl=(i,t,e)=>`#${[1,3,5].map(n=>{let[s,r]=[i,t].map(o=>parseInt(o.slice(n,n+2),16));return Math.round(s+e*(r-s)).toString(16).padStart(2,"0")}).join("")}`,ol=rl(Nr,sp,.5),rp=rl(il,Nr,.35),Or={surviving:Pi[3],reconstructed:Pi[1],hypothetical:Pi[2],"":ol};function Ur(i,t){if(!i)return ol;let e=1+Math.log10(Math.abs(i)/t)/6;return rl(Nr,Pi[i>0?0:1],Math.min(1,Math.max(.15,e)))}var al=(i,t)=>i===null?ol:rl(Nr,il,t?i/t:0);function op({bodies:i}){let t=i.map(n=>n.speed===null?0:n.sense*aM(n.speed)),e=Math.max(...t.map(Math.abs),1e-300);return t.map(n=>Ur(n,e))}var oM=[Tt.arm,Tt.plate,Tt.pipe,Tt.bezel];function ap(i,t){let e=t==="speed"?op(i):null;return({colour:n,body:s})=>t==="plain"||!oM.includes(n)?n:e?.[s]??ol}function lp(i,t){let e=op(i),n=Math.max(...i.wheels.map(r=>r.loss??0),0),s={speed:r=>e[r.body],status:r=>Or[r.status]??Or[""],loss:r=>al(r.loss,n)};return i.wheels.map(s[t]??(r=>$n[r.body%$n.length]))}function aM(i){let[t,e="1"]=i.split("/");return Number(t)/Number(e)}var cp=.14,lM=.07,cM=.05,hM=.75,Is=class{constructor(t,e,n,s,r){Object.assign(this,{scene:t,palette:e,wheels:n,parts:s,sight:r}),this.chosen=null,this.selected=null,this.toothed=!1,this.front=null,this.broken=this.wheelsOf({pairs:t.pairs.flatMap(({broken:o},a)=>o?[a]:[])})}paint(t,e){this.mode=t,this.base=e?.wheels??lp(this.scene,t),this.part=ap(this.scene,t),this.recolour()}highlight(t,e){this.chosen=t&&{wheels:this.wheelsOf(t),bodies:t.bodies??[],colour:e??Oh},this.recolour()}select(t){this.selected=t,this.recolour()}wheelsOf({wheels:t=[],bodies:e=[],pairs:n=[]}){let s=o=>typeof o=="number"?this.scene.pairs[o]:this.scene.pairs.find(({id:a})=>a===o),r=new Set([...t,...n.flatMap(o=>s(o)?.wheels??[])]);return this.scene.wheels.forEach(({body:o},a)=>e.includes(o)&&r.add(a)),r}recolour(){let{chosen:t}=this;this.wheels.forEach((s,r)=>{let[o,a,l]=[t?.wheels.has(r),this.broken.has(r),r===this.selected],c=new Ut(a?sl:this.base[r]);o&&c.lerp(new Ut(t.colour),.8),l&&c.set(Oh);let h=this.mode!=="plain"||a||o||l;s.paint({colour:c,gloss:h?.35:hM,opacity:t&&!o&&!l?cp:1})});let e=new Set([...[...t?.wheels??[]].map(s=>this.scene.wheels[s].body),...t?.bodies??[]]),n=({body:s,plate:r})=>!t||e.has(s)&&!r;for(let s of this.parts){let r=n(s)?this.isGlass(s)?lM:1:cp;this.palette.paint(s.slot,{opacity:r,...s.colour&&this.part&&{colour:new Ut(this.part(s))}})}}glaze(t,e){if(this.eye?.equals(t))return;this.eye=t.clone();let n=t.clone().sub(e),s=({cover:o,at:a,pane:l})=>l?this.sight.hidden(l,t)>cM:n.dot(o)*a.clone().sub(e).dot(o)>0,r=this.parts.filter(o=>o.cover&&s(o)||o.bar&&this.sight.isCovering(o.bar,t));this.glass?.length===r.length&&r.every((o,a)=>o===this.glass[a])||(this.glass=r,this.recolour())}isGlass(t){return!!this.glass?.includes(t)}hideBefore(t){this.front=t;let e=this.scene.wheels.map(({centre:a})=>t?G(a).dot(t):0),[n,s]=[Math.min(...e),Math.max(...e)],r=({at:a})=>t!==null&&a!==null&&a.dot(t)>(n+s)/2+1e-9,o=s-n<1e-6;this.wheels.forEach(a=>a.show(o||!r(a),this.toothed));for(let a of this.parts)(a.dial!==void 0||a.cover)&&this.palette.paint(a.slot,{shown:!r(a)})}showTeeth(t){this.toothed=t,this.hideBefore(this.front)}};var uM=2*Math.PI,zt=class{constructor(){Object.assign(this,{points:[],normals:[],grains:[],indices:[]})}get corners(){return this.points.length/3}corner(t,e,n){this.points.push(t[0],t[1],t[2]),this.normals.push(e[0],e[1],e[2]),this.grains.push(n[0],n[1],n[2])}face(t,e,n){let s=this.corners;t.forEach((r,o)=>this.corner(r,e,Array.isArray(n[0])?n[o]:n));for(let r=2;r<t.length;r+=1)this.indices.push(s,s+r-1,s+r);return this}};function te(i,t,e,n=0,s=1){let{points:r,normals:o,grains:a,indices:l}=i;return t.reduce((h,[u,d],f)=>h+u*t[(f+1)%t.length][1]-t[(f+1)%t.length][0]*d,0)<0&&(t=t.toReversed()),t.forEach(([h,u],d)=>{let[f,m]=t[(d+1)%t.length],x=Math.hypot(f-h,m-u);if(!x||h<1e-12&&f<1e-12)return;let[p,g]=[(m-u)/x,(h-f)/x],S=i.corners;for(let w=0;w<=e;w+=1){let b=uM*(n+s*w/e),[R,A]=[Math.cos(b),Math.sin(b)];r.push(h*R,h*A,u,f*R,f*A,m),o.push(p*R,p*A,g,p*R,p*A,g),a.push(-A,R,0,-A,R,0)}for(let w=S;w<S+2*e;w+=2)l.push(w,w+1,w+2,w+1,w+3,w+2)}),i}function xe(i,t,e,n){let s=Math.min(.12*(n-e),.25*(t-i));return[[i,e],[t-s,e],[t,e+s],[t,n-s],[t-s,n],[i,n]]}var Dn=(i,t,e,n=14)=>te(new zt,xe(0,i,t,e),n),ll=(i,t=16)=>te(new zt,hp(i,t/2),t),Uh=(i,t,e=24)=>te(new zt,hp(i,e),e,t,.5),hp=(i,t)=>Array.from({length:t+1},(e,n)=>{let s=Math.PI*(n/t-.5);return[i*Math.max(0,Math.cos(s)),i*Math.sin(s)]});function bn(i,t,e,n,s=r=>r){let r=l=>s(l).map((c,h)=>c-s([0,0,0])[h]),o=r([1,0,0]),a=(l,c,h)=>s([l,c,h]);for(let l=1;l<t.length;l+=1){let[[c,h],[u,d]]=[t[l-1],t[l]];for(let[f,m]of[[e,-1],[n,1]])i.face([a(c,-h,f),a(u,-d,f),a(u,d,f),a(c,h,f)],r([0,0,m]),o);for(let f of[-1,1]){let m=Math.hypot(u-c,d-h),x=r([(h-d)/m,f*(u-c)/m,0]);i.face([a(c,f*h,e),a(u,f*d,e),a(u,f*d,n),a(c,f*h,n)],x,o)}}for(let[[l,c],h]of[[t[0],-1],[t.at(-1),1]])c>1e-9&&i.face([a(l,-c,e),a(l,c,e),a(l,c,n),a(l,-c,n)],r([h,0,0]),o);return i}function cl(i,t,e,n){let s=(o,a,l)=>[0,22,45,65,82].map(c=>{let h=c*Math.PI/180;return[l-a*o*Math.cos(h),o*Math.sin(h)]}),r=[[0,t],[.3*t,t],[1.6*t,n],[i-1.6*e,n],[i-.3*e,e],[i,e]];return[...s(t,1,0),...r.filter(([o],a)=>a<2||a>3||o>.9*t&&o<i-.9*e),...s(e,-1,i).reverse()]}var dM=1.45,fM=[0,0,1],pM=[0,0,0];function dp(i,t){let e=i.dials[t];if(e.look==="ball")return[_M(i,t)];let n=i.pointers.flatMap(d=>d.dial===t?[d.level]:[]),s=Math.min(.012*e.radius,e.seated?.25*Math.min(...n):1/0),r=G(e.centre).addScaledVector(G(e.normal),e.plate?.5*s:0).toArray(),o=$t(r,e.normal,e.zero),a=mM(e),l=e.placed?1.005:1.03,c=te(new zt,xe(a,e.radius*l,-s,0),72),h=te(new zt,e.placed?[]:xe(e.radius*l,e.radius*1.075,-s,1.2*s),72),u={body:e.body,matrix:o,at:G(e.centre),dial:t,plate:!0};return[{...u,colour:Tt.face,gloss:.05,shape:c},{...u,colour:Tt.bezel,gloss:.8,shape:h},{...u,colour:Tt.mark,gloss:0,shape:gM(e)}]}function mM({radius:i,scale:t}){let e=t.turns>1?t.outer-t.inner+(t.outer-t.inner)/t.turns+.02:.26;return Math.max(.05,t.outer-e)*i}function Bh(i){let[t,e]=[0,0];return Array.from({length:i.length/2},(n,s)=>[(t+=i[2*s])/4e3,(e+=i[2*s+1])/4e3])}function gM({radius:i,engraving:t}){let e=new zt;for(let[n,s,r]of t){let o=n==="letters"?s:dM*s;for(let a of r){let l=Bh(a).map(([c,h])=>[i*h,-i*c]);for(let c=1;c<l.length;c+=1)fp(e,l[c-1],l[c],o*i,.004*i)}}return e}function fp(i,[t,e],[n,s],r,o){let a=Math.hypot(n-t,s-e)||1,[l,c]=[(n-t)*r/2/a,(s-e)*r/2/a],[h,u]=[.7*l,.7*c];i.face([[t-h+c,e-u-l,o],[n+h+c,s+u-l,o],[n+h-c,s+u+l,o],[t-h-c,e-u+l,o]],fM,pM)}function _M(i,t){let{body:e,centre:n,normal:s,radius:r}=i.dials[t],o=te(new zt,xe(1.06*r,1.25*r,-.2*r,.2*r),40),a=$t(n,[0,0,i.front],s);return{body:e,colour:Tt.bezel,gloss:.8,shape:o,matrix:a,at:G(n),dial:t}}function pp(i,t,e){let{dial:n}=i.pointers[t],{look:s,centre:r,normal:o,radius:a}=i.dials[n];if(s!=="ball")return bM(i,t,e);let c={gloss:.3,matrix:$t(r,o,[0,0,i.front]),at:G(r),dial:n};return[{...c,colour:Tt.mark,shape:Uh(a,-.25)},{...c,colour:Tt.silver,shape:Uh(a,.25)}]}var xM=.07;function Fr({pointers:i,dials:t},e){let n=i[e],s=({dial:o})=>t[o].radius,r=({body:o,dial:a,seat:l})=>l&&n.seat&&o===n.body&&a!==null&&String(t[a].normal)===String(t[n.dial].normal);return i.reduce((o,a,l)=>r(a)&&s(a)>s(i[o])?l:o,e)}function Ls(i,t){let{pointers:e}=i;if(e[t].dial===null)return 0;let n=Fr(i,t);return e.slice(0,n).filter(({dial:s})=>s===e[n].dial).length}function kh({outline:i,reach:t,ball:e},n,s){let r=n*t*(e?1:1-xM*(s%4));return i.map(([o,a])=>[r*o,r*a])}var Fh=23.44*Math.PI/180,yM=.62,up=.05;function vM(i){let t=Math.asin(Math.sin(Fh)*Math.sin(i)),e=Math.atan2(Math.cos(Fh)*Math.sin(i),Math.cos(i)),n=Math.tan((Math.PI/2+t)/2)/Math.tan((Math.PI/2+Fh)/2);return[n*Math.cos(e),n*Math.sin(e)]}function MM({hand:i,ball:t,reach:e},n,s,[r,o]){let a=n.scale.outer*n.radius;if(i==="ecliptic"){let d=Array.from({length:120},(g,S)=>vM(Math.PI*S/60).map(w=>yM*a*w)),f=(d[30][1]+d[90][1])/2,m=d[30][1]-f,x=te(new zt,xe(m-up*a,m,r,o),96);for(let g=0;g<x.corners;g+=1)x.points[3*g+1]+=f;let p=new zt;for(let g=0;g<120;g+=10){let[S,w]=d[g],b=1-up*a/m;fp(p,[S,w],[b*S,f+b*(w-f)],.008*a,o+.002*a)}return[{...s,colour:Tt.bezel,shape:x},{...s,colour:Tt.mark,gloss:0,shape:p}]}if(!t)return[];let[l,c]=[e*a-t*n.radius,t*n.radius],h=ll(c,20);for(let d=0;d<h.corners;d+=1)h.points[3*d]+=l,h.points[3*d+2]+=o+.6*c;let u=i==="bead"?te(new zt,xe(l-.3*c,l+.3*c,r,o),72):new zt;return[{...s,shape:h},{...s,colour:Tt.bezel,shape:u}]}function bM(i,t,e){let n=i.pointers[t],s=i.dials[n.dial],{radius:r,scale:o}=s,a=Math.min(.012*r,n.seat?.9:1/0),[l,c]=[n.level-a/2,n.level+a/2],h=G(s.centre),u={colour:en[e%en.length],gloss:.35,matrix:$t(h.toArray(),s.normal,s.zero),at:h,dial:n.dial},d=b=>te(b,xe(0,Math.max(.05*r,Math.min(.75*n.seat,Math.max(.55*n.seat,.35*r))),l,c+.004*r),20);if(o.turns===1)return[{...u,shape:d(bn(new zt,kh(n,o.outer*r,e),l,c))},...MM(n,s,u,[l,c])];let[f,m]=[o.inner*r,(o.outer-o.inner)*r],x=[[-.2,.02],[-.16,.035],[-.1,.03],[0,.026],[o.inner-.14,.026],[o.inner-.12,.034],[o.inner-.06,.034],[o.inner-.05,.026]],p=d(bn(new zt,x.map(b=>b.map(R=>R*r)),l,c)),g=[[f-m-.1*r,.012],[f-.03*r,.012],[f-.02*r,.02],[f+.01*r,.02],[f+.03*r,.004]],S=bn(new zt,g.map(([b,R])=>[b,R*r]),c,c+a),w=S.corners;te(S,xe(0,.014*r,.002*r,c+1.8*a),12);for(let b=w;b<S.corners;b+=1)S.points[3*b]+=f;return[{...u,shape:p},{...u,colour:Tt.mark,gloss:.5,shape:S,slides:t}]}var Ii=(i,t)=>(i%t+t)%t,nn=class{constructor(t,e,n){this.machine=e,this.index=n,this.pointer=t.pointers[n],this.order=Ls(t,n),this.dial=this.pointer.dial===null?null:t.dials[this.pointer.dial],this.scale=this.dial?.scale??{turns:1,divisions:0,way:1,names:[]},this.turns=this.scale.turns,this.sense=this.pointer.sense*this.scale.way,this.start=this.sense*(t.bodies[this.pointer.body].start-t.bodies[this.pointer.base].start)/(2*Math.PI),this.travels=t.bodies[this.pointer.body].travels,this.known=this.pointer.speed!==null&&!!e}get now(){if(!this.known)return null;if(this.travels){let{whole:n,angle:s}=this.machine.pointer(this.index);return{travel:Number(n)+s/(2*Math.PI),scale:this.scale,cell:null}}let t=Ii(this.sense*this.machine.pointer(this.index).along,this.turns),{divisions:e}=this.scale;return{turns:t,degrees:Ii(t,1)*360,scale:this.scale,cell:e>1?t/this.turns*e:null}}};function Ds(i,t=2){let e=i.toFixed(t);return`${Number(e)===360?0 .toFixed(t):e}°`}var SM=({cell:i,scale:t})=>Math.floor(i+1e-9)%t.divisions;function wM(i){let{scale:t,turns:e}=i,n=SM(i),s=t.names.find(([o,a,l])=>o&&n+1e-9>=hl(a)&&n+1e-9<hl(a)+hl(l)),r=t.turns>1?[`turn ${Math.floor(e+1e-9)%t.turns+1}`]:[];return s&&r.push(s[0]),t.cells?.length?r.push(t.cells[n]):s?t.names.length<t.divisions&&r.push(`${t.cell} ${n-Math.floor(hl(s[1]))+1}`):r.push(`${t.cell} ${EM(t,n)}`),r.push(...t.glyphs.filter(([o,a])=>a&&o===n+1).map(([,o])=>o)),r.join(", ")}var EM=({counted:i,radial:t},e)=>i?t?Ii(e-1,i)+1:e%i:e+1,hl=i=>{let[t,e=1]=i.split("/");return t/e};function Ns(i){return i?i.travel!==void 0?`${i.travel.toFixed(2)} mm`:i.cell===null?Ds(i.degrees):`${Ds(i.degrees)}, ${wM(i)}`:"not determined"}var TM=.035,AM=.7,RM=({bodies:i,dials:t,pointers:e})=>t.flatMap(({look:n,centre:s},r)=>{let o=e.find(({dial:a})=>a===r)?.body;return n==="ball"&&o!==void 0?[{...i[o],point:s,as:o,ball:r}]:[]}),CM=({bodies:i,dials:t,pointers:e})=>e.flatMap(({body:n,dial:s},r)=>s!==null&&t[s].scale.turns>1?[{...i[n],as:n,slide:r}]:[]);function PM(i,{kind:t,point:e,direction:n,down:s,length:r,rate:o},a){let l=$t(e,n,s),c=r+Math.max(.1*r-r,o*a),h=new Qt;t==="pendulum"?h.makeRotationZ(TM*Math.sin(o*a)):t==="line"?h.makeScale(c/r,1,1):h.makeTranslation(c-r,0,0),i.copy(l).multiply(h).multiply(l.invert())}var Os=class{constructor(t,e,n,s){Object.assign(this,{machine:t,main:e,middle:n,parting:s,share:0});let{scene:r}=t,o=r.bodies.findIndex(a=>a.parent===null);this.bodies=[...r.bodies,...RM(r),...CM(r),...r.hangers.map((a,l)=>({...a,parent:o,as:a.body,hangs:l}))],this.readings=this.bodies.map(({slide:a})=>a===void 0?null:new nn(t.scene,t,a)),this.root=new Bn,this.nodes=this.bodies.map(()=>new Bn),this.nodes.forEach(a=>a.matrixAutoUpdate=!1),this.bodies.forEach(({parent:a},l)=>(a===null?this.root:this.nodes[a]).add(this.nodes[l])),this.shifts=this.bodies.map(()=>new N),this.skewed=this.bodies.map((a,l)=>this.isSkew(l))}isSkew(t){let{parent:e,direction:n}=this.bodies[t];return e!==null&&(!he(n,this.main.toArray())||this.isSkew(e))}turn(t){this.bodies.forEach((e,n)=>{if(e.parent===null)return;let s=this.machine.moves?this.machine.joint(e.as??n):0,{matrix:r}=this.nodes[n];if(e.to!==void 0&&e.to!==null)return;if(e.hangs!==void 0)return PM(r,e,this.unwound(e.as,s));let o=G(e.point);if(e.travels)return r.makeTranslation(G(e.direction).multiplyScalar(s/(2*Math.PI)).add(this.shifts[n]));r.makeRotationAxis(G(e.direction),s);let a=this.slid(n);r.setPosition(o.clone().sub(a).applyMatrix4(r).negate().add(o).add(this.shifts[n]))}),this.root.updateMatrixWorld(!0),this.bodies.forEach((e,n)=>typeof e.to=="number"&&this.#t(e,this.nodes[n].matrixWorld)),this.nodes.forEach((e,n)=>t.set(e.matrixWorld.elements,16*n))}#t({body:t,to:e,point:n,direction:s,down:r,length:o},a){let l=G(n).applyMatrix4(this.nodes[t].matrixWorld),h=G(n).addScaledVector(G(r),o).applyMatrix4(this.nodes[e].matrixWorld).sub(l),u=G(s).transformDirection(this.nodes[t].matrixWorld);a.copy($t(l.toArray(),u.toArray(),h.toArray())).scale(G([h.length()/o,1,1])).multiply($t(n,s,r).invert())}unwound(t,e){let{machine:n}=this;if(!n.moves||n.simulated)return e;let s=2*Math.PI*n.scene.bodies[t].sense*n.speeds[t]*n.made();return e+2*Math.PI*Math.round((s-e)/(2*Math.PI))}explode(t){this.share=t,this.bodies.forEach(({parent:e},n)=>{if(this.shifts[n].set(0,0,0),!this.skewed[n]||this.skewed[e])return;let s=this.faced(n),r=s?G(s.centre):this.anchor(n),o=r.clone().sub(this.middle),a=s?0:AM;this.shifts[n].addScaledVector(o,t*a).addScaledVector(this.main,t*(this.height(r)-a*o.dot(this.main)))})}faced(t){let{pointers:e,dials:n}=this.machine.scene,{ball:s}=this.bodies[t];if(s!==void 0)return n[s];let r=e.find(({body:o,dial:a})=>o===t&&a!==null);return r&&!this.skewed[n[r.dial].body]?n[r.dial]:null}shift(t){let{parent:e}=this.bodies[t],n=this.shifts[t].clone();return e===null?n:n.add(this.shift(e))}slid(t){let e=this.readings[t];if(!e)return new N;let{zero:n,radius:s,scale:r}=e.dial;return G(n).multiplyScalar(s*(r.outer-r.inner)*(e.now?.turns??0)/r.turns)}slide(t){return this.bodies.findIndex(e=>e.slide===t)}ball(t){return this.bodies.findIndex(e=>e.ball===t)}hanger(t){return this.bodies.findIndex(e=>e.hangs===t)}anchor(t){let e=this.machine.scene.wheels.filter(({body:s})=>s===t).map(({centre:s})=>G(s)),n=e.reduce((s,r)=>s.add(r),new N);return e.length?n.divideScalar(e.length):G(this.bodies[t].point)}height(t){return this.parting*(t.dot(this.main)-this.middle.dot(this.main))}lift(t,e){return this.skewed[t]?0:e?this.height(e):n=>this.height(n)}apart(t,e){return t.clone().addScaledVector(this.main,this.share*e)}};var IM="http://www.w3.org/2000/svg";function mp(i,t,e){for(let[n,s]of Object.entries(t??{}))s==null||s===!1||(n.startsWith("on")?i.addEventListener(n.slice(2),s):i.setAttribute(n,s===!0?"":String(s)));return i.append(...e.flat(1/0).filter(n=>n!=null&&n!==!1&&n!=="")),i}function M(i,t,...e){return mp(document.createElement(i),t,e)}function Gt(i,t,...e){return mp(document.createElementNS(IM,i),t,e)}function ul(i,t=i){let e=null;try{e=new URL(i)}catch{return M("span",{},t)}return["http:","https:"].includes(e.protocol)?M("a",{href:e.href,target:"_blank",rel:"noopener noreferrer"},t):M("span",{},t)}function mn(i){return Gt("svg",{viewBox:"0 0 24 24",class:"icon","aria-hidden":"true",focusable:"false"},Gt("path",{d:i}))}function Fe(i,t,e={}){return M("label",{class:"field",...e},M("span",{},i),t)}function zh(i,t,e){return M("details",{class:"more",ontoggle:e},M("summary",{},i),t)}var LM=0,Vh=i=>`${i}-${LM+=1}`;var gp=48,DM=.75,_p=[.42,.38,.82],NM={front:[0,0,1],back:[0,0,-1],side:[1,0,0],free:_p},OM=.045,UM={slot:()=>0,paint:()=>{}},dl=class{constructor(t){Object.assign(this,{onPick:()=>{},onCrank:()=>{},onOrbit:()=>{}}),this.#t(t),this.paint("plain"),this.look("free")}rebuild(t){let{share:e}=this.poses;this.#t(t),this.paint("plain"),this.explode(e)}#t(t){let{scene:e}=t;Object.assign(this,{machine:t,scene:e}),this.main=nl(e);let n=Yi(e),s=el(e,n.flatMap(Ln),this.main);this.poses=new Os(t,this.main,Qa(e,n).center,s);let r=e.wheels.filter(({direction:o})=>he(o,this.main.toArray()));this.flat=r.length>DM*e.wheels.length,this.canvas??=Gt("svg",{class:"plan"}),this.canvas.replaceChildren(),this.wheels=e.wheels.map((o,a)=>new Gh(this,o,a)),this.hands=e.pointers.filter(({dial:o})=>o!==null).map(o=>new Wh(this,o)),this.faces=e.dials.map(o=>new Hh(this,o)),this.looks=new Is(e,UM,this.wheels,[])}setTurns(t){this.machine.turns=nt.of(t),this.request()}paint(t,e){this.looks.paint(t,e)}highlight(t,e){this.looks.highlight(t,e)}select(t){this.looks.select(t)}explode(t){this.poses.explode(t),this.fit()}hideFront(t){this.looks.hideBefore(t?this.main.clone().multiplyScalar(this.scene.front*Math.sign(this.main.z||1)):null);for(let{node:e}of[...this.faces,...this.hands])e.style.display=t?"none":""}look(t){let[e,n,s]=NM[t==="free"&&this.flat?"front":t]??_p,r=this.scene.front||1;this.towards=G([e*r,n,s*r]).normalize(),this.right=G([0,1,0]).cross(this.towards).normalize(),this.up=this.towards.clone().cross(this.right),this.fit()}fit(){let t=tl(this.scene,this.poses).map(l=>this.seen(l)),e=l=>[Math.min(...t.map(c=>c[l])),Math.max(...t.map(c=>c[l]))],[[n,s],[r,o]]=[e(0),e(1)];this.width=Math.max(s-n,o-r,1e-6);let a=.04*this.width;this.canvas.setAttribute("viewBox",[n-a,r-a,s-n+2*a,o-r+2*a].join(" ")),this.render()}seen(t){return[t.dot(this.right),-t.dot(this.up)]}path(t,e,n){let s=this.poses.share*this.poses.lift(t,e),{matrixWorld:r}=this.poses.nodes[t],o=a=>this.seen(a.clone().addScaledVector(this.main,s).applyMatrix4(r));return`M${n.map(a=>o(a).map(l=>l.toFixed(3)).join(" ")).join("L")}`}request(){this.waiting||=requestAnimationFrame(()=>this.render())}render(){cancelAnimationFrame(this.waiting),this.waiting=0,this.poses.turn(new Float32Array(16*this.poses.nodes.length));let t=[...this.faces,...this.wheels,...this.hands];for(let n of t)n.draw();let e=t.sort((n,s)=>n.depth-s.depth).map(({node:n})=>n);e.some((n,s)=>n!==this.canvas.children[s])&&this.canvas.replaceChildren(...e)}depth(t,e){return e.clone().applyMatrix4(this.poses.nodes[t].matrixWorld).dot(this.towards)}cut(){}showTeeth(){}theme(){}resize(){}dispose(){cancelAnimationFrame(this.waiting)}},Gh=class{constructor(t,e,n){let{id:s,teeth:r,kind:o,body:a,centre:l,direction:c,reference:h,turn:u}=e;Object.assign(this,{plan:t,wheel:e,body:a,at:G(l),ring:o==="ring"}),this.frame=$t(l,c,h,u),this.disc=Gt("path",{class:"disc"}),this.spoke=Gt("path",{class:"spoke"}),this.name=Gt("text",{},s);let d=Gt("title",{},`${s}, ${r} teeth`);this.node=Gt("g",{class:"wheel","data-wheel":s,onclick:()=>t.onPick(n)},d,this.disc,this.spoke,this.name)}paint({colour:t,opacity:e}){this.disc.setAttribute("fill",`#${t.getHexString()}`),this.disc.setAttribute("stroke",`#${t.clone().multiplyScalar(.35).getHexString()}`),this.node.setAttribute("opacity",e)}show(t){this.node.style.display=t?"":"none"}draw(){let{plan:t,body:e,wheel:n,frame:s,ring:r}=this,o=c=>t.path(e,this.at,c),[a,l]=r?[n.radius,Dr(n)]:[0,n.radius];this.disc.setAttribute("d",`${o(Xh(s,l))}Z${r?`${o(Xh(s,a))}Z`:""}`),this.spoke.setAttribute("d",o([a,l].map(c=>G([c,0,0]).applyMatrix4(s)))),this.write(o([this.at]).slice(1).split(" ").map(Number)),this.depth=t.depth(e,this.at)}write([t,e]){let{plan:n,wheel:s,ring:r}=this,o=Math.min(.03*n.width,1.6*s.radius/Math.max(2,s.id.length));this.name.textContent=!r&&s.radius>OM*n.width?s.id:"";for(let[a,l]of Object.entries({x:t,y:e+.36*o,"font-size":o}))this.name.setAttribute(a,l.toFixed(3))}},Hh=class{constructor(t,e){Object.assign(this,{plan:t,dial:e,at:G(e.centre),frame:$t(e.centre,e.normal,e.zero)}),this.rim=Gt("path",{}),this.node=Gt("g",{class:"face"},Gt("title",{},e.title),this.rim)}draw(){let{plan:t,dial:e,at:n,frame:s}=this,r=a=>t.path(e.body,n,a),o=[.94,1.06].map(a=>G([a*e.radius,0,0]).applyMatrix4(s));this.rim.setAttribute("d",`${r(Xh(s,e.radius))}Z${r(o)}`),this.depth=t.depth(e.body,n)}},Wh=class{constructor(t,{output:e,body:n,dial:s}){let{centre:r,normal:o,zero:a,radius:l}=t.scene.dials[s],c=$t(r,o,a);Object.assign(this,{plan:t,body:n,at:G(r)}),this.ends=[0,.9*l].map(h=>G([h,0,0]).applyMatrix4(c)),this.line=Gt("path",{}),this.node=Gt("g",{class:"pointing","data-output":e},Gt("title",{},e),this.line)}draw(){this.line.setAttribute("d",this.plan.path(this.body,this.at,this.ends)),this.depth=this.plan.depth(this.body,this.at)+1e-6}};function Xh(i,t){return Array.from({length:gp},(e,n)=>{let s=2*Math.PI*n/gp;return G([t*Math.cos(s),t*Math.sin(s),0]).applyMatrix4(i)})}var[FM,BM]=[400,new nt(13n,64n)],kM=12,qh=8,[zM,VM]=[.001,.1],GM=.15,fl=({speed:i,sense:t})=>t*Number(nt.parse(i)??0);function pl(i){return Math.min(VM,Math.max(zM,GM/Math.max(1,...i.pointers.map(t=>Math.abs(fl(t))))))}function HM(i,t){let e=[0,1,...i.map(([n,s])=>((n*t+s)%1+1)%1)].sort((n,s)=>n-s);return Math.min(...e.slice(1).map((n,s)=>n-e[s]))*(i.length+1)}function ml(i){if(i.run||i.driving_link===null)return nt.of(0);let t=i.dials.length?i.dials.map((d,f)=>i.pointers.filter(({dial:m})=>m===f)):[i.pointers],e=({body:d,base:f,sense:m})=>m*(i.bodies[d].start-i.bodies[f].start)/(2*Math.PI),n=d=>[...new Map(d.filter(fl).map(f=>[fl(f),[fl(f),e(f)]])).values()],s=t.map(n).filter(({length:d})=>d),r=nt.of(i.step),o=BM.times(Math.abs(Number(r))<1?r:nt.of(1)),a=Number(o),l=d=>s.reduce((f,m)=>f*HM(m,d*a),1),[c,h]=[0,0],u=i.hangers.length?kM:FM;for(let d=1;d<=u;d+=1)l(d)>h&&([c,h]=[d,l(d)]);return o.times(c)}function gl({note:i,bodies:t,driving_link:e,pointers:n,dials:s,asks:r}){if(i)return/^.+?(?<!\b[A-Z])\.(?=\s+[A-Z0-9(]|\s*$)/s.exec(i)?.[0]??i;if(e===null||!r)return"";let o=n.filter(({dial:c})=>!s.length||c!==null).map(({output:c})=>c),a=o.length>qh?` and ${o.length-qh} more`:"",l=`${o.slice(0,qh).join(", ")}${a}`;return s.length?`${t[e].id} moves the hands of ${l}.`:`${t[e].id} drives ${l}.`}var yp=["January","February","March","April","May","June","July","August","September","October","November","December"],WM=new nt(4598321n,2n),vp={julian:new nt(3442235n,2n),gregorian:new nt(3442239n,2n)},xp=10n**9n,XM=/^([+-]?\d{1,10})-(\d{1,2})-(\d{1,2})(?:[T ](\d{1,2}):(\d{2}))?$/,qM=/^(\d{1,2})\.? +([a-z]{3,9})\.? +(\d{1,10})(?: *(bc|bce|ad|ce))?(?:,? +(\d{1,2}):(\d{2}))?$/i,Br=(i,t)=>(i-(i%t+t)%t)/t,Mp=(i,t)=>i<t?i:t;function bp({year:i,month:t,day:e,part:n,calendar:s}){let r=(t+9n)%12n,o=i-(t<3n?1n:0n),a=365n*o+Br(o,4n)+(153n*r+2n)/5n+e-1n,l=s==="gregorian"?Br(o,400n)-Br(o,100n):0n;return vp[s].plus(a+l).plus(n)}function _l(i,t=null){let e=t??(i.minus(WM).numerator<0n?"julian":"gregorian"),n=i.minus(vp[e]),s=n.floor,[r,o]=e==="gregorian"?$M(s):Sp(s),a=(5n*o+2n)/153n;return{year:r+(a>9n?1n:0n),month:(a+2n)%12n+1n,day:o-(153n*a+2n)/5n+1n,part:n.minus(s),calendar:e}}function Sp(i){let t=Br(i,1461n),e=i-1461n*t,n=Mp(e/365n,3n);return[4n*t+n,e-365n*n]}function $M(i){let t=Br(i,146097n),e=i-146097n*t,n=Mp(e/36524n,3n),[s,r]=Sp(e-36524n*n);return[400n*t+100n*n+s,r]}function YM(i,t=null){let e=ZM(i.trim().replace("−","-"));if(!e)return null;let[n,s,r,o,a]=e;if(n>xp||-n>xp||Number(o??0)>23||Number(a??0)>59)return null;let l=o===void 0?new nt(1n,2n):new nt(60n*BigInt(o)+BigInt(a),1440n),c=n<1582n||n===1582n&&(s<10n||s===10n&&r<15n),h={year:n,month:s,day:r,part:l,calendar:t??(c?"julian":"gregorian")},u=_l(bp(h),t);return["year","month","day","calendar"].every(f=>u[f]===h[f])?h:null}function ZM(i){let t=XM.exec(i);if(t)return[BigInt(t[1].replace("+","")),BigInt(t[2]),BigInt(t[3]),t[4],t[5]];let e=qM.exec(i);if(!e)return null;let n=yp.findIndex(r=>r.toLowerCase().startsWith(e[2].toLowerCase()))+1,s=BigInt(e[3]);return[/^b/i.test(e[4]??"")?1n-s:s,BigInt(n),BigInt(e[1]),e[5],e[6]]}function Zi({year:i,month:t,day:e,part:n}){let s=n.times(1440n).floor,r=[s/60n,s%60n].map(a=>String(a).padStart(2,"0")).join(":"),o=i>0n?i<1000n?`${i} AD`:i:`${1n-i} BC`;return`${e} ${yp[Number(t)-1]} ${o}, ${r}`}var Yn=class{constructor({julian_day:t,turns:e,days:n,calendar:s,source:r,note:o,unset:a}){Object.assign(this,{calendar:s,source:r,note:o,known:!a.length}),[this.day,this.turns,this.days]=[t,e,n].map(l=>nt.of(l))}dayAt(t){return this.day.plus(t.minus(this.turns).times(this.days))}dateAt(t){return _l(this.dayAt(t),this.calendar)}turnsAt(t){return this.turns.plus(bp(t).minus(this.day).over(this.days))}read(t){return YM(t,this.calendar)}};var Tp=2*Math.PI,wp=36525,xl=i=>i*Math.PI/180;function Ap(i){let t=(Number(i)-23858005e-1)/wp;return(Number(i)+(32*t*t-20)/86400-2451545)/wp}var ci=(i,t)=>i.reduceRight((e,n)=>e*t+n,0),yl=()=>new nt(BigInt(Date.now()),86400000n).plus(new nt(4881175n,2n));function Rp(i,t,e){let n=Ap(e);if(t==="moon_node")return ci(i.moon.node,n);if(t==="moon")return JM(i,n);let[s,r]=Ep(i.earth,n),[o,a]=t==="sun"?[0,0]:Ep(i[t],n);return Math.atan2(a-r,o-s)*360/Tp}function Ep(i,t){let[e,n,s,r]=["longitude","perihelion","eccentricity","distance"].map(d=>ci(i[d],t)),o=xl((e-n)%360),a=o;for(let d=0;d<20;d+=1)a-=(a-s*Math.sin(a)-o)/(1-s*Math.cos(a));let[l,c]=[r*(Math.cos(a)-s),r*Math.sqrt(1-s*s)*Math.sin(a)],[h,u]=[Math.cos(xl(n)),Math.sin(xl(n))];return[h*l-u*c,u*l+h*c]}function JM({moon:i,earth:t},e){let n=ci(i.longitude,e),[s,r,o,a]=[n-ci(i.perigee,e),n-ci(t.longitude,e)-180,ci(t.longitude,e)-ci(t.perihelion,e),n-ci(i.node,e)];return[[6.288774,s],[1.274027,2*r-s],[.658314,2*r],[.213618,2*s],[-.185116,o],[-.114332,2*a]].reduce((c,[h,u])=>c+h*Math.sin(xl(u)),n)}var Us=({epoch:i},t)=>nt.of(i.turns).plus(t.minus(i.julian_day).over(i.days)),$h=i=>i.epoch?.settings.length?Us(i,i.epoch.day??nt.of(i.epoch.julian_day)):nt.of(0);function vl(i,t){let e=KM(i,t),n=i.bodies.map((o,a)=>o.sense*(e[a]-o.start)),s=(o,a)=>n[o]-n[a],r=o=>o&&{...o,sources:o.sources.map(a=>jM(i,a,s))};return{...i,epoch:{...i.epoch,day:t},bodies:i.bodies.map((o,a)=>({...o,start:e[a]})),wheels:i.wheels.map((o,a)=>QM(i,o,a,s)),couplings:i.couplings.map(o=>({...o,slot_turn:(o.slot_turn??0)+Cp(o,s)})),movement:r(i.movement),back:r(i.back)}}function KM(i,t){let[e,n]=[Ap(t),Us(i,t)],s=i.bodies.map(r=>r.start);for(let{pointer:r,sense:o,angle:a}of i.epoch.settings){let{body:l,base:c,speed:h,dial:u}=i.pointers[r],d=nt.of(h??"0").times(n),f=BigInt(u===null?1:i.dials[u].scale.turns),m=Number(d.floor%f)+d.part;s[l]=Tp*((o*ci(a,e)/360-m)%Number(f))+i.bodies[l].sense*i.bodies[c].sense*s[c]}for(let{kind:r,pin:o,slot:a}of i.couplings){let l=i.epoch.settings.some(({pointer:c})=>i.pointers[c].body===a);r==="pin_and_slot"&&!l&&(s[a]+=i.bodies[a].sense*i.bodies[o].sense*(s[o]-i.bodies[o].start))}return s}function jM(i,t,e){let n=i.couplings.find(({id:l})=>l===t.pair);if(!n)return t;let s=t.bodies.includes(n.slot)?n.pin:n.slot,[r,o]=[s,n.carrier].map(l=>i.bodies[l].sense*Number(nt.of(i.bodies[l].speed??0))),a=(r<o?-1:1)*Math.sign(Number(nt.of(i.step)));return{...t,start:t.start+a*e(s,n.carrier)}}var Cp=({kind:i,pin:t,slot:e,carrier:n},s)=>(i==="pin_follower"?0:s(t,n))-s(e,n);function QM(i,t,e,n){let s=i.pairs.find(({wheels:l})=>l.includes(e)),r=i.couplings.find(({slot:l})=>l===t.body),o=s?-n(t.body,s.carrier):0,a=r&&t.holes.length?Cp(r,n)-o:0;return{...t,turn:t.turn+o,holes:a?t.holes.map(l=>tb(l,a)):t.holes}}var tb=(i,t)=>i.map((e,n)=>n%2?Math.sin(t)*i[n-1]+Math.cos(t)*e:Math.cos(t)*e-Math.sin(t)*i[n+1]);var eb=60;function Pp(i){return i.trim().length>eb||/e[+-]?\d{3,}/i.test(i)?null:nt.parse(i)}var Nn=i=>String(i).replace(/^-/,"−");function Fs({numerator:i,denominator:t},e=4){let n=10n**BigInt(e),r=(2n*(i<0n?-i:i)*n+t)/(2n*t),o=String(r%n).padStart(e,"0").replace(/0+$/,""),a=String(r/n).replace(/\B(?=(\d{3})+$)/g," ");return(i<0n&&r?"−":"")+a+(o?`.${o}`:"")}function kr(i){return i.denominator!==1n&&i.denominator<10000n&&i.toString().length<=14?`${Fs(i)} = ${Nn(i)}`:Fs(i)}var nb="Set the pointers to the sky at this moment",ib=100,Bs="M7 4.5v15l12.5-7.5z",Vr="M7 5h3.6v14H7zM13.4 5H17v14h-3.6z";function Ip(i){let t=i.crank===null?null:nt.parse(i.bodies[i.crank].speed),e=t?Math.abs(Number(t)):1;return e>=.05&&e<=20?e:1}var zr=class{constructor(t,e,{beside:n="",set:s=null}={}){if(this.scene=t,this.drive=e,this.gearing=Ip(t),this.lead=t.driving_link===null?"the input":t.bodies[t.driving_link].id,this.onSet=s,this.epoch=t.epoch?new Yn(t.epoch):null,this.date=this.epoch&&M("output",{class:"date","aria-live":"off"}),this.wheel=this.#t(),this.playing=M("button",{type:"button",class:"round",onclick:()=>e.play()}),this.turns=M("output",{class:"turns","aria-live":"off"}),this.fault=M("p",{class:"bad",role:"alert",id:"go-fault",hidden:!0}),this.node=M("section",{class:"crank","aria-label":"crank"},this.wheel,M("div",{class:"where"},this.turns,M("span",{class:"quiet"},`turns of ${this.lead}`),this.date,n&&M("span",{class:"quiet beside-it"},n)),M("div",{class:"buttons"},M("button",{type:"button",onclick:()=>e.unit(-1),"aria-label":"one unit of the input back"},mn("M6 5v14M19 5l-9 7 9 7z")),this.playing,M("button",{type:"button",onclick:()=>e.unit(1),"aria-label":"one unit of the input forward"},mn("M18 5v14M5 5l9 7-9 7z")),this.#o()),this.#n(),this.#s(),this.epoch?.known&&this.#a(),this.fault),!e.movable)for(let r of this.node.querySelectorAll("button, input"))r.disabled=!0}#t(){let t=[0,60,120,180,240,300].map(n=>Gt("path",{d:"M0-7V-33",transform:`rotate(${n})`}));this.hand=Gt("g",{},Gt("circle",{class:"felloe",r:36}),...t,Gt("circle",{class:"hub",r:7}),Gt("circle",{class:"knob",cy:-36,r:8}));let e=Gt("svg",{viewBox:"-50 -50 100 100",class:"handle",tabindex:this.drive.movable?0:-1,role:"slider","aria-label":`crank, turns of ${this.lead}`,"aria-valuenow":0,"aria-disabled":this.drive.movable?null:"true"},this.hand);return e.addEventListener("pointerdown",n=>this.#e(n)),e}#e(t){if(!this.drive.movable)return;let e=this.wheel.getBoundingClientRect(),n=a=>Math.atan2(a.clientY-e.top-e.height/2,a.clientX-e.left-e.width/2),s=n(t);this.wheel.setPointerCapture(t.pointerId);let r=a=>{let l=n(a),c=(l-s)/(2*Math.PI);s=l,this.drive.advance((c-Math.round(c))/this.gearing)},o=()=>{this.wheel.removeEventListener("pointermove",r),this.drive.advance(0,!0)};this.wheel.addEventListener("pointermove",r),this.wheel.addEventListener("lostpointercapture",o,{once:!0}),t.preventDefault(),this.wheel.focus({preventScroll:!0})}#n(){let{drive:t}=this,[e,n]=this.epoch?["days",Math.abs(Number(this.epoch.days))]:["turns",1],s=M("input",{type:"range",min:-3,max:2,step:.1}),r=M("input",{type:"number",class:"pace",min:0,step:"any","aria-label":`${e} a second`}),o=(a,l=!1)=>{t.rate=a;let c=Number((a*n).toPrecision(2));l||(r.value=c),s.value=Math.log10(a),s.setAttribute("aria-valuetext",`${c} ${e} a second`)};return s.addEventListener("input",()=>o(10**Number(s.value))),r.addEventListener("input",()=>Number(r.value)>0&&o(Number(r.value)/n,!0)),o(t.rate),Fe("Speed",M("span",{class:"with"},s,r,`${e}/s`),{class:"field speed"})}#s(){return this.place=M("input",{type:"text",inputmode:"text",placeholder:"235/19",autocomplete:"off",spellcheck:"false","aria-describedby":"go-fault"}),M("form",{class:"go",onsubmit:t=>this.#r(t)},Fe("Go to turn",this.place),M("button",{type:"submit"},"Go"))}#r(t){t.preventDefault();let e=Pp(this.place.value);this.#i(this.place,e,"This is not a number of turns; write 12, 2.5, 235/19 or 1e6."),e&&this.drive.play(!1),e&&this.drive.goTo(e)}#i(t,e,n){this.fault.hidden=!!e,t.setAttribute("aria-invalid",String(!e)),this.fault.textContent=e?"":n}turnBack(){this.drive.sense*=-1,this.back.setAttribute("aria-pressed",String(this.drive.sense<0))}#o(){return this.back=M("button",{type:"button","aria-pressed":String(this.drive.sense<0),"aria-label":"play backwards",title:"Play backwards",onclick:()=>this.turnBack()},mn("M4 5v5h5M4.5 10a8 8 0 1 1-.5 5")),this.back.firstChild.classList.add("line"),this.back}#a(){let t=M("input",{type:"text",placeholder:"-204-05-12",autocomplete:"off",spellcheck:"false",maxlength:40,"aria-describedby":"go-fault"}),e=()=>{let r=this.epoch.read(t.value);return this.#i(t,r,"This is not a date; write -204-05-12 or 12 May 205 BC, optionally followed by 18:30."),r&&this.epoch.turnsAt(r)},n=r=>{r.preventDefault();let o=e();o&&this.drive.play(!1),o&&this.drive.goTo(o)},s=()=>{let r=e();r&&this.drive.runTo(r)};return M("form",{class:"go day",onsubmit:n},Fe("Go to date",t),M("button",{type:"submit"},"Go"),M("button",{type:"button",onclick:s,title:"Run to this date in eight seconds"},"Run"),M("button",{type:"button",onclick:()=>this.#l(),title:nb},"Today"))}#l(){let t=yl();this.drive.play(!1),this.scene.epoch.settings.length&&this.onSet?.(t),this.drive.goTo(Us(this.scene,t))}#c(t){if(this.date.title=this.epoch.known?"":`Without a position in the sky: ${this.scene.epoch.unset.join(", ")}`,this.date.textContent="not set to the sky",!this.epoch.known)return;let e=this.epoch.dateAt(t);this.dated=performance.now(),this.date.textContent=Zi(e),this.date.title=`${e.calendar==="julian"?"Julian":"Gregorian"} calendar`}find(){this.place.focus(),this.place.select()}use(t){this.scene=t,this.gearing=Ip(t);for(let e of this.node.querySelectorAll("button, input"))e.disabled=!this.drive.movable}set(t,e){let{part:n}=t.at,s=Number(t.at.floor%1000000n);this.hand.setAttribute("transform",`rotate(${((s+n)*this.gearing*360%360).toFixed(3)})`),this.turns.textContent=kr(t.at),this.date&&(e||performance.now()-(this.dated??0)>ib)&&this.#c(t.at),(e||!t.playing)&&(this.wheel.setAttribute("aria-valuenow",String(Number(t.at))),this.wheel.setAttribute("aria-valuetext",`${kr(t.at)} turns`)),this.shown!==t.playing&&(this.shown=t.playing,this.playing.replaceChildren(mn(t.playing?Vr:Bs)),this.playing.setAttribute("aria-label",t.playing?"pause":"play"))}};var Ml=14,sb=1/25,rb=new nt(1n,72n),ks=class{constructor(t,e){this.app=t,this.step=e,this.at=nt.parse(t.turns)??nt.of(0),this.rate=.1,this.playing=!1,this.sense=1,this.movable=!0,this.run=null,this.loop=!0,this.listeners=[],this.calm=matchMedia("(prefers-reduced-motion: reduce)"),t.onTurns=n=>this.#i(n)}listen(t){this.listeners.push(t)}goTo(t,e=!0){this.movable&&(this.at=this.#e(t),this.setting=!0,this.app.setTurns(this.at.toString()),this.setting=!1,this.#r(e))}advance(t,e=!1){this.goTo(this.at.plus(nt.near(t,this.run?Ml:void 0)),e)}unit(t){this.run?this.goToTime(this.run.blowFrom(this.time,t)):this.goTo(this.at.plus(this.step.times(t)))}nudge(t){this.goTo(this.at.plus(this.run?nt.near(t*sb*this.rate,Ml):rb.times(t)))}goToTime(t,e=!0){this.goTo(nt.near(t/this.run.period,Ml),e)}get time(){return Number(this.at)*this.run.period}get#t(){return nt.near(this.run.duration/this.run.period,Ml)}#e(t){return this.run?t.numerator<0n?nt.of(0):t.minus(this.#t).numerator>0n?this.#t:t:t}play(t=!this.playing){t&&this.movable&&this.#s&&this.goTo(nt.of(0),!1),this.#n(t,e=>this.calm.matches&&e<1e3?!1:(this.loop&&this.#s?this.goTo(nt.of(0),!1):this.advance(this.sense*this.rate*Math.min(e,this.calm.matches?2e3:100)/1e3),!this.loop&&this.#s&&this.play(!1),!0))}runTo(t,e=8){if(this.calm.matches)return this.goTo(t);let n=this.at,s=t.minus(n),r=0;this.#n(!0,o=>(r+=Math.min(o,100)/1e3/e,r>=1&&this.#n(!1),this.goTo(r<1?n.plus(s.times(nt.near(r))):t,r>=1),!0))}#n(t,e){this.playing=t&&this.movable,this.#r(!this.playing);let n=this.frames={},s=performance.now(),r=o=>{!this.playing||this.frames!==n||(e(o-s)&&(s=o),requestAnimationFrame(r))};this.playing&&requestAnimationFrame(r)}get#s(){return!!this.run&&this.at.equals(this.#t)}#r(t){for(let e of this.listeners)e(this,t)}#i(t){this.setting||(this.play(!1),this.at=nt.parse(t)??this.at,this.#r(!0))}};var ob={zero:!1,carrier:null},ab=10n**12n,lb={kind:"exact",why:"",transmissions:[],sources:[],steps:[],offsets:{},period:null},bl=class{constructor(t){this.scene=t,this.given=t.formulas,this.declared=this.given.wheels.map((e,n)=>BigInt(t.wheels[this.given.count.indexOf(n)].teeth)),this.driven=nt.of(this.given.input)}at(t){return this.given.count[t]}solve(t){let e=this.given.conditions.filter(({formula:o,zero:a})=>ub(o,t)!==a),n=this.given.formulas.map(o=>hb(o,t));n.includes(null)&&!e.length&&e.push(ob);let s=e.length?n.map(()=>null):n,r=o=>o===null?null:s[o];return{bodies:this.given.bodies.map(r),pointers:this.given.pointers.map(r),broken:e}}changed(t){let{scene:e}=this,{bodies:n,pointers:s,broken:r}=this.solve(t),[o,a]=this.#e(t),l=r.length>0||e.movement.kind==="still";return{...e,bodies:e.bodies.map((c,h)=>c.parent===null?c:{...c,...this.#t(n[h])}),pointers:e.pointers.map((c,h)=>({...c,...this.#t(s[h]),text:fb(c.sense,s[h])})),wheels:gb(e,a),profiles:o,pairs:e.pairs.map(c=>({...c,text:mb(c,e.wheels,a)})),movement:{...lb,kind:l?"still":"mean",why:l?"":Zh},back:null,verdict:r.length?pb(e,r):e.verdict,changed:!0}}#t(t){if(t===null)return{speed:null,shown:null,decimal:""};let e=db(t);return{speed:t.over(this.driven).toString(),shown:this.given.exact?t.toString():e,decimal:e}}#e(t){let e=[...this.scene.profiles],n=this.scene.wheels.map((s,r)=>{let o=this.at(r),a=o===null?s.teeth:Number(t[o]);if(a===s.teeth)return s;if(s.kind==="worm")return{...s,teeth:a};let l=a/s.teeth,{points:c,...h}=e[s.profile];e.push({...h,points:c.map(([x,p])=>[1+(x-1)/l,p/l])});let[u,d,f]=[l*s.radius,s.tip,s.root],m=u-s.radius;return{...s,teeth:a,radius:u,tip:d+m,root:f+m,profile:e.length-1}});return[e,n]}meshes(t){let{scene:e}=this,n=s=>this.at(s)===null?BigInt(e.wheels[s].teeth):t[this.at(s)];return e.pairs.map(s=>{let[r,o]=s.wheels.map(d=>e.wheels[d]),a=s.wheels.map(d=>n(d)-BigInt(e.wheels[d].teeth)),l=2*r.radius/r.teeth;if(!a[0]&&!a[1])return{pair:s,off:nt.of(0),module:l};let c=[r,o].findIndex(({kind:d})=>d==="worm");if(c>=0)return{pair:s,off:new nt(a[1-c],2n),module:2*[o,r][c].radius/[o,r][c].teeth};if(!he(r.direction,o.direction))return{pair:s,off:null,apart:cb(r,o)?this.#n(s,a):null};let h=[r,o].findIndex(({kind:d})=>d==="ring"),u=h<0?a[0]+a[1]:a[h]-a[1-h];return{pair:s,off:new nt(u,2n),module:l}})}#n({wheels:t},e){return t.reduce((n,s,r)=>n+Number(e[r])*this.scene.wheels[s].radius/this.scene.wheels[s].teeth,0)}},cb=(...i)=>i.every(({cone:t,kind:e})=>!t&&e!=="contrate"),Zh="The motion of teeth and pins was computed only for the declared counts, so mean motion is shown.";function Lp(i){let t=String(i).trim(),e=/^\d{1,13}$/.test(t)?BigInt(t):0n;return e>0n&&e<=ab?e:null}function Yh(i,t,e){let n=0n;for(let[s,r]of i){let o=BigInt(s);r.forEach((a,l)=>o*=e[t[l]]**BigInt(a)),n+=o}return n}function hb({wheels:i,numerator:t,denominator:e},n){let s=Yh(e,i,n);return s===0n?null:new nt(Yh(t,i,n),s)}var ub=({wheels:i,numerator:t},e)=>Yh(t,i,e)===0n;function db(i){let[t,e]=Number(i).toPrecision(10).split("e"),n=t.includes(".")?t.replace(/\.?0+$/,""):t;return e?`${n}e${e}`:n}function fb(i,t){return t===null?"":t.numerator===0n?"at rest":`${t.numerator>0n==i>0?"clockwise":"counter-clockwise"} as read`}function pb(i,t){let e=({carrier:r})=>r!==null&&i.bodies[r].parent===null,n=t.map(r=>{let{text:o,zero:a,carrier:l}=r;if(!a)return"with these counts the train is locked or free";if(l===null)return`no longer satisfied: ${o}`;let c=e(r)?"lock each other":`can only turn with ${i.bodies[l].id} as one body`;return`${o.replace(/ closes$/,"")} no longer closes: its wheels ${c}`});return{kind:t.some(e)?"locked":"not determined",text:`${[...new Set(n)].join("; ")}. Save the train and run \`geartrain solve\` to see which links still turn.`,links:[],loops:[],advice:[]}}function mb({text:i,wheels:t},e,n){let s=0;return i.replace(/(?<= [+-] |^)(\d+) \(/g,(r,o)=>{let a=t[s++];return a!==void 0&&Number(o)===e[a].teeth?`${n[a].teeth} (`:r})}function gb(i,t){let e=[...t],n=t.map(()=>[]);i.pairs.forEach(({wheels:[r,o]})=>{n[r].push(o),n[o].push(r)});let s=new Set;return t.forEach((r,o)=>{if(s.has(o))return;let a=[o];s.add(o);for(let c of a)for(let h of n[c])s.has(h)||a.push((s.add(h),h));if(a.every(c=>t[c]===i.wheels[c]))return;let l=new Set([o]);for(let c of a)for(let h of n[c])l.has(h)||(l.add(h),e[h]=_b(e[h],e[c]))}),e}function _b(i,t){let e=G(t.centre).sub(G(i.centre)),n=G(i.direction);if(e.addScaledVector(n,-e.dot(n)),!he(i.direction,t.direction)||e.length()<1e-9)return i;let s=i.kind==="ring"||t.kind==="ring",r=e.normalize().multiplyScalar(t.kind==="ring"?-1:1),o=s?r:r.clone().negate(),a=n.dot(G(t.direction))>0?1:-1,c=(s?a:-a)*xb(t,o)+.5;return{...i,turn:Dp(i,r)+2*Math.PI*c/i.teeth}}var xb=(i,t)=>(i.turn-Dp(i,t))*i.teeth/(2*Math.PI);function Dp({direction:i,reference:t},e){let n=G(t);return Math.atan2(G(i).cross(n).dot(e),n.dot(e))}async function Gr(i){try{return await navigator.clipboard.writeText(i),!0}catch{let t=M("textarea",{class:"unseen","aria-hidden":"true"});t.value=i,document.body.append(t),t.select();let e=document.execCommand("copy");return t.remove(),e}}function zs(i,t){let e=M("button",{type:"button",class:"copy",title:`Copy ${i}`,"aria-label":`${i}, copy`},Nn(i).split(/(?<=\/)/).flatMap(n=>[n,M("wbr")]));return e.addEventListener("click",async n=>{n.stopPropagation();let s=document.activeElement,r=await Gr(i);s instanceof HTMLElement&&s.focus({preventScroll:!0}),e.classList.toggle("copied",r),t(r?`${i} copied`:"the browser does not permit copying"),setTimeout(()=>e.classList.remove("copied"),1200)}),e}var yb=36525,Jh=({pointers:i,epoch:t})=>i.some(({targets:e})=>e.length)||!!(t&&(t.settings.length||t.unset.length));function Op(i,t,e){let n=$h(i.machine.scene),s=nt.of(t.speed).times(e.minus(n)).plus(nt.of(i.pointer.speed).times(n));return Ii(i.sense*(Number(s.floor%BigInt(i.turns))+s.part)+i.start,i.turns)}var Hr=({epoch:i},t)=>i?.settings.find(({pointer:e})=>e===t)?.body||void 0;function Up({machine:i,index:t}){let{epoch:e}=i.scene;return Ii(Rp(e.elements,Hr(i.scene,t),new Yn(e).dayAt(i.made()))/360,1)}var Fp=i=>Hr(i.machine.scene,i.index)?Up(i):Op(i,i.pointer.targets[0],i.machine.made()),Np=(i,t,e)=>nt.of(i.speed).minus(t.speed).times(e);function Sl(i){let t=Number(i)*360;if(!t)return"0°";let e=Math.abs(t),n=e<5e-5||e>=1e6?e.toExponential(1):e<5e-4?e.toFixed(4):e<100?e.toFixed(3):e<1e3?e.toFixed(2):e.toFixed(0);return`${t<0?"−":"+"}${n}°`}var wl=class{constructor(t,{say:e,onSet:n}){Object.assign(this,{say:e,onSet:n,rows:[],heavens:[]}),this.node=M("div",{},t.map(s=>this.#t(s,t.length>1)))}#t(t,e){let{scene:n}=t;if(!Jh(n))return e&&M("p",{class:"quiet"},`${t.label} has no targets.`);let r=["output, target","pointer","target","pointer ahead",n.unit_days===null?"per unit":"per century"];return[e&&M("h3",{},t.label),n.epoch&&Mb(n),n.epoch?.settings.length>0&&this.#e(t),M("p",{class:"tells quiet"},"The sky is the true geocentric longitude from the equinox of the date (of the Moon's node, the mean longitude). Targets are mean motions without anomalies, which agree with the pointers when these are set. Errors of targets are exact; click one to copy it in turns."),M("div",{class:"scroll",tabindex:0,role:"region","aria-label":"targets"},M("table",{class:"sky"},M("thead",{},M("tr",{},r.map(o=>M("th",{scope:"col"},o)))),M("tbody",{},n.pointers.flatMap((o,a)=>[this.#n(t,a),...o.targets.map(l=>this.#s(t,a,l))]))))]}#e({scene:t,machine:e}){let n=new Yn(t.epoch),s=nt.of(t.epoch.day??t.epoch.julian_day),r=M("button",{type:"button",class:"small"},"Set at the displayed date");return r.addEventListener("click",()=>this.onSet(n.dayAt(e.made()))),M("p",{class:"set"},`Pointers set to the sky: ${Zi(_l(s,n.calendar))} `,r)}#n(t,e){let{scene:n,machine:s}=t,{output:r}=n.pointers[e],o=Hr(n,e),a=n.epoch?.unset.includes(r);if(!o&&!a)return null;let l=[0,1,2].map(()=>M("td",{class:"angle"}));return a?l[1].textContent="not set to the sky":this.heavens.push({reading:new nn(n,s,e),cells:l}),M("tr",{"data-heaven":r},M("th",{scope:"row"},r,M("div",{class:"quiet"},o==="moon_node"?"the sky, mean node":"the sky")),l,M("td",{class:"angle"},"–"))}#s(t,e,n){let{scene:s,machine:r}=t,o=s.pointers[e],[a,l]=[M("td",{class:"angle"}),M("td",{class:"angle"})],c=M("button",{type:"button",class:"copy"});c.addEventListener("click",async()=>{let u=c.dataset.exact;this.say(await Gr(u)?`${u} turns copied`:"the browser does not permit copying")});let h=s.unit_days===null?nt.of(s.step):nt.of(s.step).times(yb).over(s.unit_days);return this.rows.push({reading:new nn(s,r,e),target:n,own:a,sky:l,error:c,machine:r}),M("tr",{"data-pointer":o.output,"data-target":n.label},M("th",{scope:"row"},o.output,M("div",{class:"quiet"},vb(n.label))),a,l,M("td",{class:"angle"},c),M("td",{class:"angle"},Sl(Np(o,n,h))))}set(t){if(!(!t||!this.node.offsetParent)){for(let{reading:e,cells:n}of this.heavens){let s=[e.now.degrees,Up(e)*360],r=Ii(s[0]-s[1]+180,360)-180;n.forEach((o,a)=>o.textContent=a<2?Ds(s[a]):Sl(r/360))}for(let{reading:e,target:n,own:s,sky:r,error:o,machine:a}of this.rows){let l=a.made(),c=Np(e.pointer,n,l.minus($h(a.scene)));s.textContent=Ds(e.now.degrees),r.textContent=Ds(Ii(Op(e,n,l),1)*360),o.textContent=Sl(c),o.dataset.exact=c.toString(),o.title=`${Nn(c.toString())} turns`,o.setAttribute("aria-label",`${Sl(c)} ahead, copy the exact turns`)}}}},vb=i=>i.split(/(?<=_)/).flatMap(t=>[t,M("wbr")]);function Mb(i){let t=new Yn(i.epoch),e=i.bodies[i.driving_link].id,n=t.turns.numerator===0n?`${e} had made no turns`:`${e} had made ${t.turns} turns`,s=t.dateAt(t.turns),r=i.sources[t.source]?.cite,o=s.calendar==="julian"?"Julian":"Gregorian";return M("p",{class:"epoch"},`${n} on ${Zi(s)} (${o} calendar).`,t.note&&` ${t.note}`,t.source&&M("span",{class:"quiet"},` ${t.source}${r?`: ${r}`:""}`))}var Ji=90,Kh=(i,t,e)=>{let n=2*Math.PI*i+e;return[t*Math.sin(n),-t*Math.cos(n)]},Wr=i=>`${i[0].toFixed(2)} ${i[1].toFixed(2)}`,bb=i=>`M${Bh(i).map(([t,e])=>Wr([Ji*t,-Ji*e])).join("L")}`;function Sb(i){let[t,,e]=i.normal,n=[e,0,-t],s=Math.hypot(...n);if(s<1e-6)return 0;let r=(i.zero[0]*n[0]+i.zero[2]*n[2])/s;return Math.atan2(r,i.zero[1])}var El=class{constructor(t,e,n){this.scale=e.scale,this.engraving=e.engraving,this.zero=Sb(e),this.hands=n.map(s=>({reading:s,node:this.#n(s),sky:this.#s(s)})),this.node=Gt("svg",{viewBox:"-100 -100 200 200",class:"dial",role:"img","aria-label":`dial ${t}`},Gt("circle",{r:97,class:"face"}),...this.#e(),...this.hands.flatMap(s=>s.sky??[]),...this.hands.map(s=>s.node),Gt("circle",{r:3.2,class:"boss"}))}#t(t){let{inner:e,outer:n,turns:s}=this.scale;return Ji*(e+(n-e)*t/s)}#e(){let t={transform:`rotate(${(this.zero*180/Math.PI).toFixed(6)})`},e=this.engraving.map(([r,o,a])=>Gt("path",{class:r,"stroke-width":(o*Ji).toFixed(3),d:a.map(bb).join("")})),n=[-.011,.011].map(r=>Wr(Kh(r,Ji+8,0))),s=Gt("path",{class:"zero",d:`M${n[0]}L${n[1]}L${Wr(Kh(0,Ji+1.5,0))}Z`});return[Gt("g",t,...e,s)]}#n(t){let{order:e}=t,n=Gt("g",{class:`hand hand-${e%en.length}`,"data-output":t.pointer.output});return this.draw(n,t,e),n}#s({order:t,pointer:e,machine:n,index:s}){let[r]=e.targets;if(!r)return null;let o=Gt("title",{},Hr(n.scene,s)?`${e.output} in the sky`:`${e.output} by ${r.label}, mean motion`);return Gt("circle",{class:`target hand-${t%en.length}`,r:4,"data-output":e.output},o)}draw(t,{pointer:e},n){let s=this.scale.turns>1,r=kh(e,Ji*this.scale.outer,n),o=r.map(([l,c])=>Wr([c,-l])),a=r.map(([l,c])=>Wr([-c,-l])).reverse();t.append(Gt("path",{class:"needle",d:s?"":`M${[...o,...a].join("L")}Z`})),s&&t.append(Gt("circle",{class:"follower",r:3}))}#r(t,e){let[n,s]=Kh(this.scale.way*e,this.#t(e),this.zero);t.setAttribute("cx",n.toFixed(3)),t.setAttribute("cy",s.toFixed(3)),t.setAttribute("data-turns",e.toFixed(12))}#i(t,e){let n=(2.6-e).toFixed(3);t.querySelector(".needle").setAttribute("d",`M-1.6 14L-1.1 ${n}L1.1 ${n}L1.6 14Z`),t.querySelector(".follower").setAttribute("cy",(-e).toFixed(3))}set(){for(let{reading:t,node:e,sky:n}of this.hands){let s=t.now;if(n&&this.#r(n,Fp(t)),e.classList.toggle("unknown",!s),!s)continue;let r=(this.scale.way*s.degrees+this.zero*180/Math.PI)%360;e.setAttribute("transform",`rotate(${r.toFixed(6)})`),e.setAttribute("data-turns",s.turns.toFixed(12)),this.scale.turns>1&&this.#i(e,this.#t(s.turns))}}};var wb=4;function jh(i,t){let[e,n]=[nt.parse(i),nt.parse(t)];if(!e||!n)return null;let s=n.minus(e);return{gap:s.toString(),part:e.numerator===0n?null:Number(s.over(e))}}function Qh(i){if(i===null||i===0)return"";let t=Math.abs(i),e=t<.001?`${(t*1e6).toPrecision(3)} ppm`:`${(t*100).toPrecision(3)} %`;return`${i<0?"−":"+"}${e}`}function Eb({bodies:i,pointers:t}){let[e,n]=[t.length,i.length-1];return`This train declares no outputs; ${e<n?`the first ${e} of its ${n} links are listed`:"its links are listed"}.`}var Tl=class{constructor(t,{onChoose:e,onSet:n,say:s}){Object.assign(this,{sides:t,onChoose:e,say:s}),this.dials=[],this.angles=[],this.rows=[],this.names=[...new Set(t.flatMap(o=>o.scene.pointers.map(a=>a.output)))],this.one=t.every(o=>o.scene.unit===t[0].scene.unit);let r=t.some(({scene:o})=>o.epoch?.settings.length)?"the sky and targets":"targets";this.sky=t.some(({scene:o})=>Jh(o))&&new wl(t,{say:s,onSet:n}),this.comparison=this.sky&&zh(`Comparison with ${r}`,this.sky.node,()=>this.set(!0)),this.search=M("input",{type:"search",placeholder:"Find an output","aria-label":"find an output",oninput:()=>this.#l()}),this.node=M("div",{},this.names.length>12&&this.search,!this.one&&M("p",{class:"note"},"The two trains use different units of speed, so no differences are shown."),t.map(({scene:o})=>!o.asks&&M("p",{class:"quiet"},Eb(o))),this.#t(),this.comparison)}#t(){let t=[...new Set(this.sides.flatMap(({scene:o})=>o.dials.map(({title:a})=>a)))],e=t.map(o=>({title:o,names:this.names.filter(a=>this.#e(a)===o)})),n=this.names.filter(o=>!this.#e(o)),s=[t.length&&this.#n(e.flatMap(({title:o,names:a})=>[this.#s(o),...a.map(l=>this.#i(l))]))];if(!n.length)return s;let r=this.#n(n.map(o=>this.#i(o)));return t.length?(this.others=zh(`${n.length} outputs without a dial`,r,()=>this.set(!0)),[...s,this.others]):r}#e(t){return this.sides.map(({scene:n})=>n.dials[n.pointers.find(({output:s})=>s===t)?.dial]).find(Boolean)?.title??""}#n(t){let e=this.sides.length>1,n=[...this.sides.flatMap(({label:s})=>e?[s,"speed"]:["reading","speed, exact"]),e&&"difference"];return M("div",{class:"scroll",tabindex:0,role:"region","aria-label":"outputs"},M("table",{class:"outputs"},M("caption",{class:"unseen"},"Outputs; choose one to see its path from the input"),M("thead",{},M("tr",{},["output",...n].filter(Boolean).map(s=>M("th",{scope:"col"},s)))),M("tbody",{},t)))}#s(t){let e=this.sides.flatMap(({scene:n,machine:s,label:r})=>{let o=n.dials.find(l=>l.title===t),a=n.pointers.map((l,c)=>new nn(n,s,c)).filter(l=>o&&l.dial===o);return a.length?[this.#r(o,a,this.sides.length>1&&r)]:[]});return M("tr",{class:"faces"},M("td",{colspan:this.sides.length>1?6:3},M("div",{class:"cards"},e)))}#r(t,e,n){let s=new El(t.title,t,e);this.dials.push(s);let{divisions:r,turns:o,cell:a,names:l}=t.scale,c=r>1&&`${r} ${a}s${o>1?` on ${o} turns`:""}`;return M("figure",{class:l.length>wb||e.length>2?"card wide":"card"},s.node,M("figcaption",{},M("strong",{},t.title),[n,c,t.look==="scale"&&!t.placed&&"layout computed",t.note].filter(Boolean).map(h=>M("span",{class:"quiet said"},h))))}#i(t){let e=this.sides.map(h=>h.scene.pointers.findIndex(u=>u.output===t)),n=e.map((h,u)=>this.sides[u].scene.pointers[h]),s=this.sides.map(({scene:h,machine:u},d)=>n[d]&&new nn(h,u,e[d])),r=s.find(h=>h?.dial),o=M("button",{type:"button",class:"plain","aria-pressed":"false",onclick:()=>this.onChoose(t)},r&&M("span",{class:`key hand-${r.order%en.length}`,"aria-hidden":"true"}),t),a=s.flatMap(h=>this.#o(h));this.sides.length>1&&a.push(this.#a(n));let l=n.map(h=>h?.note).find(Boolean),c=M("tr",{"data-output":t},M("th",{scope:"row",title:l},o),a);return this.rows.push({name:t,row:c,pick:o}),c}#o(t){if(!t)return[0,1].map(()=>M("td",{class:"quiet"},"–"));let{pointer:e}=t,n=M("td",{class:"angle","data-angle":e.output});this.angles.push({reading:t,angle:n});let s=e.shown!==null,r=s?zs(e.shown,this.say):M("span",{class:"quiet"},"not determined"),o=s&&e.decimal!==e.shown&&M("div",{class:"quiet decimal"},Nn(e.decimal));return[n,M("td",{class:"number"},r,o)]}#a(t){let[e,n]=t.map(r=>r?.shown??null),s=this.one?jh(e,n):null;return s?s.gap==="0"?M("td",{class:"number quiet"},"none"):M("td",{class:"number","data-gap":s.gap},zs(s.gap,this.say),M("div",{class:"quiet"},Qh(s.part))):M("td",{class:"quiet"},"–")}#l(){let t=this.search.value.trim().toLowerCase();for(let{name:e,row:n}of this.rows)n.hidden=!e.toLowerCase().includes(t);for(let e of this.node.querySelectorAll(".faces"))e.hidden=!!t;t&&this.others&&(this.others.open=!0)}mark(t){let e=this.rows.find(({pick:n})=>n.getAttribute("aria-pressed")==="true")?.pick;for(let n of this.rows)n.row.classList.toggle("chosen",n.name===t),n.pick.setAttribute("aria-pressed",String(n.name===t));return e}set(t){if(this.node.offsetParent){for(let e of this.dials)e.set();if(t)for(let{reading:e,angle:n}of this.angles)n.textContent=Ns(e.now);this.sky&&this.sky.set(t)}}};var Tb=/^[A-Za-z_][A-Za-z0-9_-]*$/,Ab=new Set(["null","true","false","yes","no","on","off","y","n"]),Rb="All tooth counts are as declared. They can be changed under Wheels: all speeds are then recomputed exactly, and the changes are listed here.",Xr=i=>Tb.test(i)&&!Ab.has(i.toLowerCase())?i:JSON.stringify(i);function Cb(i){let{scene:t,steps:e}=i,{parent:n}=t.formulas,s=new Map;for(let{wheel:r,link:o,count:a}of e)s.set(o,[...s.get(o)??[],`${Xr(r)}: {teeth: ${a}}`]);return[`name: ${Xr(`${t.name}-changed`)}`,`title: ${JSON.stringify(`${t.title||t.name}, with other counts`)}`,`extends: ${Xr(n).startsWith('"')&&!/[:#{}[\],&*?|<>=!%@\\"' ]/.test(n)?n:Xr(n)}`,"links:",...[...s].map(([r,o])=>`  ${Xr(r)}: {wheels: {${o.join(", ")}}}`),""].join(`
`)}var Bp=i=>i?"further apart":"closer together";function tu({pair:i,off:t,apart:e,module:n}){if(t===null&&e===null)return`${i.id}: its axes intersect, so its wheels must be redesigned and repositioned`;if(t===null&&!e)return"";if(t===null)return`${i.id}: needs axes ${Math.abs(e).toPrecision(3)} mm ${Bp(e>0)} (as drawn)`;if(t.numerator===0n)return"";let s=t.numerator<0n?nt.of(0).minus(t):t,r=`${s} ${s.equals(1)?"module":s.denominator===1n?"modules":"of a module"}`;return`${i.id}: needs axes ${r} ${Bp(t.numerator>0n)} (${(Number(s)*n).toPrecision(3)} mm as drawn)`}var Al=class{constructor(t,{onCounts:e,say:n}){Object.assign(this,{onCounts:e,say:n});let s=t.filter(({steps:r})=>r.length);this.node=M("div",{},s.length?s.map(r=>this.#t(r,t.length>1)):M("p",{class:"quiet"},Rb))}#t(t,e){let n=M("button",{type:"button",class:"small",onclick:()=>this.onCounts(t,t.formulas.declared),"data-key":"reset"},"All as declared"),s=t.meshes.map(tu).filter(Boolean);return M("section",{class:"change","aria-label":"changes"},M("div",{class:"row"},M("h3",{},e?`${t.label}, changed`:"Changed"),n),M("ul",{class:"counts"},t.steps.map(({wheel:r,declared:o,count:a})=>M("li",{"data-changed":r},`${r}: ${o} → ${a} teeth`))),M("h4",{},"Meshes"),s.length?M("ul",{class:"misfits"},s.map(r=>M("li",{class:"bad"},r))):M("p",{},"All meshes still fit their axes."),t.declared.movement.kind==="real"&&M("p",{class:"quiet"},Zh),M("h4",{},"Outputs"),this.#e(t),this.#n(t))}#e({scene:t,declared:e}){let n=t.pointers.flatMap((r,o)=>{let a=e.pointers[o].shown;if(a===r.shown)return[];let l=jh(a,r.shown),c=[a,r.shown].map(h=>M("td",{class:"number"},h===null?"not determined":Nn(h)));return[M("tr",{"data-turned":r.output},M("th",{scope:"row"},r.output),c,M("td",{},l?Qh(l.part):""))]});return n.length?M("div",{class:"scroll",tabindex:0,role:"region","aria-label":"changed outputs"},M("table",{},M("thead",{},M("tr",{},["output","declared","now","change"].map(r=>M("th",{scope:"col"},r)))),M("tbody",{},n))):M("p",{},"No output speed has changed.")}#n(t){let e=Cb(t),n=`${t.scene.name}-changed.yaml`.replace(/[^\w.-]+/g,"-"),s=()=>{let o=URL.createObjectURL(new Blob([e],{type:"application/yaml"}));M("a",{href:o,download:n}).click(),setTimeout(()=>URL.revokeObjectURL(o),1e3),this.say(`${n} saved`)},r=async()=>this.say(await Gr(e)?"declaration copied":"the browser does not permit copying");return[M("h4",{},"Declaration"),M("pre",{class:"yaml",tabindex:0},e),M("div",{class:"buttons"},M("button",{type:"button",onclick:s,"data-key":"save"},"Save YAML"),M("button",{type:"button",onclick:r,"data-key":"copy"},"Copy"))]}};function eu(i,t,e,n,s=!1){let r=i.formulas?.at(t)??null;if(r===null)return null;let{id:o}=i.scene.wheels[t],a=i.counts[r],l=u=>e(i,i.counts.map((d,f)=>f===r?u:d)),c=(u,d,f)=>M("button",{type:"button",class:"step","aria-label":`one tooth ${f} on ${o}`,"data-key":`${n} ${i.index} ${o} ${u}`,disabled:a+u<1n,onclick:()=>l(a+u)},d),h=s&&M("input",{type:"text",inputmode:"numeric",maxlength:13,value:a,"aria-label":`teeth of ${o}`,"data-key":`${n} ${i.index} ${o}`,onchange:u=>{let d=Lp(u.target.value);d===null?u.target.value=a:d!==a&&l(d)}});return M("span",{class:"stepper"},c(-1n,"−","less"),h,c(1n,"+","more"))}function kp(i,t){let e=i.pairs.filter(n=>(t.pairs??[]).includes(n.id));return{pairs:e.map(n=>n.id),wheels:[...new Set(e.flatMap(n=>n.wheels))],bodies:e.length?[]:i.bodies.flatMap((n,s)=>(t.links??[]).includes(n.id)?[s]:[])}}function Pb({scene:i},t){return i.elements?.length?M("ul",{class:"elements","aria-label":"brakes and clutches"},i.elements.map(e=>M("li",{},M("button",{type:"button",class:e.closed?"element closed":"element",title:e.text,"aria-label":`${e.text}, ${e.closed?"closed":"open"}`,onclick:()=>t(e)},e.one_way?`${e.id} ↻`:e.id)))):null}function zp(i,t,e,n){let{kind:s,text:r,loops:o=[]}=i.scene.verdict,a=s!=="determined";return M("div",{class:a?"verdict bad":"verdict","data-verdict":s},a&&M("p",{},t&&M("span",{},`${i.label}: `),M("strong",{},s),r&&r!==s&&` ${r}`),o.length?M("ul",{class:"loops"},o.map(l=>M("li",{},M("button",{type:"button",class:"loop",onclick:()=>e(i,l)},l.text||(l.pairs??l.links??[]).join(", "))))):null,Pb(i,l=>n(i,l)))}var Rl=class{constructor(t,{compare:e,theme:n,onKeys:s,onShow:r,onLoop:o,onElement:a,onChanged:l}){this.all=t,this.onShow=r,this.onLoop=o,this.onElement=a,this.onChanged=l,this.title=M("h1",{}),this.names=M("p",{class:"quiet names"}),this.verdicts=M("div",{class:"verdicts"}),this.first=this.#t(0,!1),this.second=this.#t(e&&t.length>1?1:"",!0);let c=t.length>1,u=t.some(({machine:f})=>f.run)?"Motion":t.some(f=>f.scene.state)&&!e?"State":"Train",d=c&&Fe("Beside",this.second);this.choices=M("div",{class:"choices"},c&&Fe(u,this.first),e&&d),this.node=M("header",{class:"head"},M("div",{},this.title,this.names,this.verdicts),this.choices),this.rest=[c&&!e&&d,Fe("Theme",n),M("button",{type:"button",class:"for-keys",onclick:s,"aria-haspopup":"dialog"},"Keys")].filter(Boolean),this.write()}#t(t,e){let n=M("select",{onchange:()=>this.#e()},e&&M("option",{value:""},"nothing"),this.all.map((s,r)=>M("option",{value:r},s.label)));return n.value=String(t),n}#e(){this.write(),this.onShow(this.sides)}get sides(){let t=[this.first.value,this.second.value].filter(e=>e!=="").map(Number);return[...new Set(t)].map(e=>this.all[e])}#n(t){let e=t.meshes.filter(tu).length,n=t.steps.map(({wheel:o,declared:a,count:l})=>`${o} ${a} → ${l}`),s=e?`${e} ${e===1?"mesh no longer fits its axes":"meshes no longer fit their axes"}`:"all meshes still fit their axes",r=M("button",{type:"button",class:"plain",onclick:()=>this.onChanged()},n.slice(0,6).join(", ")+(n.length>6?", ...":""));return M("span",{class:"changed"}," changed: ",r,`; ${s}`)}write(){let{sides:t}=this,e=t.length>1,n=[...new Set(t.map(({scene:r})=>r.title||r.name))];this.title.textContent=n.join(" and ");let s=[...new Set(t.map(({scene:r})=>r.name))];this.names.replaceChildren(s.length>1?s.join(", "):gl(t[0].scene),...t.filter(({steps:r})=>r.length).slice(0,1).map(r=>this.#n(r))),this.verdicts.replaceChildren(...t.map(r=>zp(r,e,(o,a)=>this.onLoop(o,kp(o.scene,a)),this.onElement)))}};var Ib=[["Left, Right","turn back or forward by five degrees; with Shift by one unit of the input"],["Page Up, Page Down","one unit of the input forward or back"],["G","go to a number of turns"],["B","play backwards, or forwards again"]],Lb=[["Home","back to the start"],["Space","play or pause"],["/","find a wheel"],["1, 2, 3, 4","view from the front, the back, the side, or freely"],["C","next colours"],["E","take apart, put together"],["H","hide or show the front"],["N","names of the parts on or off"],["T","teeth on or off"],["?","this list"],["Escape","close, or clear the selection"]],Db=[["Left, Right","step by 1/25 s of playback; with Shift to the previous or next impact"],["Page Up, Page Down","to the next or previous impact"],["G","go to the time slider"]],nu="Drag the crank, or the handle in the picture. Drag elsewhere in the picture to rotate the view, pinch or scroll to zoom, click a wheel for details.",Vp="input:not([type=checkbox]):not([type=range]), textarea, select",Gp={1:"front",2:"back",3:"side",4:"free"},Cl=class{constructor(t){this.actions=t,this.letters=M("input",{type:"checkbox"}),this.letters.checked=!0;let e=M("button",{type:"button",onclick:()=>this.dialog.close()},"Close");this.dialog=M("dialog",{"aria-labelledby":"keys-title"},M("h2",{id:"keys-title"},"Keys"),M("dl",{class:"keys"},[...t.timed?Db:Ib,...Lb].map(([n,s])=>[M("dt",{},M("kbd",{},n)),M("dd",{},s)])),M("p",{},nu),M("label",{class:"field tick"},M("span",{},"Single-letter shortcuts"),this.letters),e),this.node=this.dialog,document.addEventListener("keydown",n=>this.#t(n))}open(){this.dialog.showModal()}#t(t){if(t.ctrlKey||t.metaKey||t.altKey||t.defaultPrevented||this.dialog.open)return;let e=t.target instanceof Element?t.target:document.body;if(t.key==="Escape"){e.matches(Vp)&&e.blur(),this.actions.escape();return}if(e.closest(Vp))return;(this.#e(t,e)||this.letters.checked&&this.#n(t.key))&&t.preventDefault()}#e({key:t,shiftKey:e},n){let{drive:s}=this.actions;if(t===" "&&!n.closest("button, a, input, summary"))return s.play(),!0;if(n.closest("[role=tablist], input, .scroll")||n.closest(".pages")&&t.startsWith("Page"))return!1;let r={ArrowRight:1,ArrowUp:1,ArrowLeft:-1,ArrowDown:-1}[t];return r&&!((t==="ArrowUp"||t==="ArrowDown")&&!n.closest(".handle, canvas"))?(e?s.unit(r):s.nudge(r),!0):t==="PageUp"||t==="PageDown"?(s.unit(t==="PageUp"?1:-1),!0):t==="Home"?(s.goTo(nt.of(0)),!0):!1}#n(t){let{tools:e,goTo:n,find:s,back:r}=this.actions;if(Gp[t])return e.look(Gp[t]),!0;let o={g:n,"/":s,b:r,c:()=>e.next(),e:()=>e.takeApart(),h:()=>e.toggle(e.front),n:()=>e.toggle(e.names),t:()=>e.toggle(e.teeth),"?":()=>this.open()}[t.toLowerCase()];return o?.(),!!o}};var Nb=8,Pl=class{constructor(){this.node=M("div",{class:"unseen",role:"status","aria-live":"polite","aria-atomic":"true"}),this.readings=[]}use(t){this.readings=t.flatMap(e=>{let n=e.scene.pointers.map((r,o)=>new nn(e.scene,e.machine,o)),s=n.filter(r=>r.dial);return(s.length?s:n).slice(0,Nb).map(r=>({reading:r,label:t.length>1?`${e.label} `:""}))})}say(t){clearTimeout(this.waiting),this.node.textContent=t}rest(t){clearTimeout(this.waiting),this.waiting=setTimeout(()=>{if(t.playing)return;let e=this.readings.map(({reading:n,label:s})=>`${s}${n.pointer.output} ${Ns(n.now)}`);this.node.textContent=[t.run?`${t.time.toPrecision(4)} seconds`:`${kr(t.at)} turns`,...e].join("; ")},500)}};function Ob(i){return M("li",{},M("strong",{},i.what),i.why&&`: ${i.why}`,i.fix&&M("span",{class:"quiet"},` ${i.fix}`),i.place&&M("span",{class:"quiet"},` (${i.place})`))}function Ub([i,t]){let{cite:e,url:n,...s}=t;return M("li",{id:`source-${i}`},M("strong",{},i),e&&` ${e}`,n&&[" ",ul(n)],Object.values(s).map(r=>M("span",{class:"quiet"},` ${r}`)))}function Fb(i){if(i.run&&!i.touching)return M("p",{},"All angles are those of a simulation with inertia, backlash and friction, to 0.006 degrees.");let{kind:t,why:e}=i.movement;return M("p",{},{exact:"All angles are exact: rational multiples of the turns of the crank.",real:"Mean speeds are exact; the deviations caused by teeth and pins were computed in advance.",mean:"Only mean motion is shown; the motion of teeth and pins could not be computed.",still:"The train does not move."}[t]??"",e&&` ${e}`)}function Hp(i,t){let{scene:e}=i,n=Object.entries(e.sources);return M("article",{},M("h3",{},t?i.label:e.name),M("p",{},`${e.verdict.kind}: ${e.verdict.text}`),e.note&&M("p",{},e.note),M("p",{class:"quiet"},`${[[e.wheels,"wheel"],[e.pairs,"gear pair"],[e.couplings,"pin"]].filter(([{length:s}])=>s).map(([{length:s},r])=>`${s} ${r}${s===1?"":"s"}`).join(", ")}.`,e.unit&&` Speeds in ${e.unit}.`),Fb(e),e.notices.length?[M("h4",{},"Simplifications of the picture"),M("ul",{class:"notices"},e.notices.map(Ob))]:null,M("h4",{},"Sources"),n.length?M("ul",{class:"sources"},n.map(Ub)):M("p",{class:"quiet"},"No sources are given."))}var Bb=6,kb=1/3,zb=12,Wp=84,Vb=4,Xp=.5,Il=class{constructor(t){this.run=t,this.onSeek=()=>{},this.pace=1;let e=Math.min(16,Math.max(4,110/Math.max(1,t.contacts.length)));Object.assign(this,{lane:e,named:e>=zb,height:Math.ceil(e*t.contacts.length)}),this.node=M("canvas",{class:"strip",role:"img","aria-label":"contacts near this moment; the table under Contacts lists them",style:`height: ${this.height}px`}),this.node.addEventListener("pointerdown",n=>this.#s(n)),this.width=0,new ResizeObserver(()=>{this.width=this.node.clientWidth,this.#r()}).observe(this.node)}set(t){this.time=t,this.#r()}get#t(){return this.named?Wp:0}get#e(){return Math.min(Bb*this.pace,this.run.duration)}get#n(){return Math.min(Math.max(0,this.time-(1-kb)*this.#e),this.run.duration-this.#e)}#s(t){let[e,n]=[t.clientX,this.time],s=this.#e/(this.width-this.#t),r=!1,o=l=>{r||=Math.abs(l.clientX-e)>Vb,r&&this.onSeek(n-(l.clientX-e)*s,!1)},a=()=>{this.node.removeEventListener("pointermove",o);let l=e-this.node.getBoundingClientRect().left-this.#t;r?this.onSeek(this.time,!0):l>=0&&this.onSeek(this.#n+l*s,!0)};this.node.setPointerCapture(t.pointerId),this.node.addEventListener("pointermove",o),this.node.addEventListener("lostpointercapture",a,{once:!0})}#r(){let{width:t}=this;if(!t||this.time===void 0)return;let e=Math.min(globalThis.devicePixelRatio||1,2),[n,s]=[Math.round(t*e),Math.round(this.height*e)];(this.node.width!==n||this.node.height!==s)&&Object.assign(this.node,{width:n,height:s});let r=this.node.getContext("2d"),o=this.#i();r.setTransform(e,0,0,e,0,0),r.clearRect(0,0,t,this.height),r.font="11px system-ui, sans-serif",r.textBaseline="middle";let[a,l,c]=[this.#n,this.#e,this.#t],h=u=>c+(u-a)/l*(t-c);this.run.contacts.forEach((u,d)=>this.#o(r,u,d,o,h,a,t)),r.fillStyle=o.ink,r.fillRect(h(this.time)-.75,0,1.5,this.height)}#i(){let{theme:t}=document.documentElement.dataset;if(!this.colours||this.theme!==t){let e=getComputedStyle(this.node),n=s=>e.getPropertyValue(`--${s}`).trim();this.colours={line:n("line"),ink:n("ink"),a:n("apart"),c:n("coast"),blow:n("blow")},this.theme=t}return this.colours}#o(t,e,n,s,r,o,a){let[l,c,h]=[n*this.lane,this.lane-1,o+this.#e];t.fillStyle=s.line,t.fillRect(this.#t,l+c,a,1),this.named&&(t.fillStyle=s.ink,t.fillText(e.name,0,l+c/2,Wp-8));let u=-1/0;for(let[m,x,p]of this.run.stretches(n,o,h)){let[g,S]=[Math.max(r(x),this.#t),r(p)];m==="d"||S<u+Xp||(t.fillStyle=s[m],t.fillRect(g,l+.15*c,Math.max(.7,S-g),.7*c),u=Math.max(S,g+.7))}let[d,f]=[-1/0,0];t.fillStyle=s.blow;for(let[m,x]of this.run.blowsOf(n,o,h)){let p=r(m);p<d+Xp&&x<=f||(t.fillRect(p-.75,l+c*(1-x),1.5,c*x),[d,f]=[p,x])}}};var Gb=10,[Hb,Wb]=[-3,1];function qp(i,t){let e=Math.min(6,Math.max(0,4-Math.ceil(Math.log10(Math.max(t,.001)))));return`${i.toFixed(e)} s`}function iu(i){let t=Math.max(0,...i.contacts.map(({impact_rate:e})=>e));return Math.min(1,Math.max(.02,Gb/Math.max(t,1e-9)))}var Ll=class{constructor(t,e){Object.assign(this,{drive:e,run:t.machine.run});let{run:n}=this;this.time=M("output",{class:"turns","aria-live":"off"}),this.playing=M("button",{type:"button",class:"round",onclick:()=>e.play()}),this.slider=M("input",{type:"range",class:"moment",min:0,max:n.duration,step:"any","aria-label":"time",oninput:()=>e.goToTime(Number(this.slider.value),!1),onchange:()=>e.goToTime(Number(this.slider.value))}),this.loop=M("input",{type:"checkbox",onchange:()=>e.loop=this.loop.checked}),this.loop.checked=e.loop,this.strip=new Il(n),this.strip.onSeek=(r,o)=>e.goToTime(r,o);let s=(r,o,a)=>M("button",{type:"button",onclick:()=>e.unit(r),"aria-label":o,title:o},mn(a));this.node=M("section",{class:"crank playhead","aria-label":"time"},M("div",{class:"buttons"},s(-1,"previous impact","M6 5v14M19 5l-9 7 9 7z"),this.playing,s(1,"next impact","M18 5v14M5 5l9 7-9 7z")),M("div",{class:"where"},this.time,M("span",{class:"quiet"},`of ${qp(n.duration,n.duration)}; ${su(t.scene.run.rate)} of ${t.lead}`)),this.#t(iu(n)),Fe("Repeat",this.loop,{class:"field tick"}),this.slider,this.strip.node)}#t(t){let e=M("span",{class:"pace"}),n=M("input",{type:"range",min:Hb,max:Wb,step:.05,value:Math.log10(t)}),s=()=>{let r=Math.abs(n.value)<.03?1:10**Number(n.value);this.drive.rate=r/this.run.period,this.run.pace=r,this.strip.pace=r;let o=Number(r.toPrecision(2));e.textContent=r===1?"real time":`${o} × real time`,n.setAttribute("aria-valuetext",r===1?"real time":`${o} × real time`),this.drive.goTo(this.drive.at,!this.drive.playing)};return n.addEventListener("input",s),s(),Fe("Speed",M("span",{class:"with"},n,e),{class:"field speed"})}find(){this.slider.focus()}set(t,e){let n=Math.min(this.run.duration,Math.max(0,Number(t.at)*this.run.period)),s=qp(n,this.run.duration);this.time.textContent=s,this.slider.value=String(n),(e||!t.playing)&&this.slider.setAttribute("aria-valuetext",s),this.strip.set(n),this.shown!==t.playing&&(this.shown=t.playing,this.playing.replaceChildren(mn(t.playing?Vr:Bs)),this.playing.setAttribute("aria-label",t.playing?"pause":"play"))}};function su(i){let t=Math.abs(i)/(2*Math.PI),[e,n]=t<.001?[3600,"h"]:[1,"s"],s=Number((t*e).toPrecision(4));return`${s} ${s===1?"turn":"turns"}/${n}`}var Xb={d:"drive flank",c:"coast flank",a:"separated","":"–"},$p={pair:"",pin:"pin",escapement:"escapement"},ru=2e-4,qb=i=>i?`${Number((100*i).toFixed(i<.01?3:i<.1?2:1))} %`:"0",Nl=i=>String(Number(i.toPrecision(3))).replace("-","−"),Dl=i=>`${Nl(i*180/Math.PI)}°`,Ol=class{constructor(t,e){this.onChoose=e,this.rows=[],this.leads=[];let n=t.filter(({machine:s})=>s.simulated);this.node=M("div",{},n.map(s=>this.#t(s,t.length>1)),n.length?null:M("p",{class:"quiet"},"In this motion all drive flanks are in contact, as without inertia."))}#t(t,e){let{run:n}=t.scene;return M("section",{},e&&M("h3",{},t.label),M("ul",{class:"legend tells"},ou("blow","impact"),ou("apart","teeth separated"),ou("coast","contact on the coast flank")),n.contacts.length?M("div",{class:"scroll",tabindex:0,role:"region","aria-label":"contacts"},this.#e(t)):M("p",{class:"quiet"},"No pair has real teeth, a pin or a loss, so there are no separations or impacts."),this.#n(t),M("p",{},$b(n)),n.complete?null:M("p",{class:"bad"},"The simulation was stopped before its end."),n.notes.map(s=>M("p",{class:"note"},s)))}#e(t){let{scene:e,machine:n}=t,s=["contact","now","separated","coast","impacts/s","maximum"],r=e.run.contacts.map((o,a)=>{let l=M("td",{class:"now"});this.rows.push({now:l,state:()=>n.run.state(a,n.time())});let c=[o.apart,o.coast].map(h=>M("td",{class:"number"},qb(h)));return M("tr",{"data-contact":o.name},M("th",{scope:"row"},M("button",{type:"button",class:"plain",onclick:()=>this.onChoose(t,a)},o.name),$p[o.kind]&&M("div",{class:"quiet"},$p[o.kind])),l,c,M("td",{class:"number"},Nl(o.impact_rate)),M("td",{class:"number"},o.hardest?`${Dl(o.hardest)}/s`:"–"))});return M("table",{class:"outputs contacts"},M("caption",{class:"unseen"},"Contacts: present state, and shares of the whole run"),M("thead",{},M("tr",{},s.map(o=>M("th",{scope:"col"},o)))),M("tbody",{},r))}#n({scene:t,machine:e}){if(!t.run.deviations.length)return null;if(!t.run.deviations.some(({ahead:s,behind:r})=>qr(s,ru)||qr(r,ru)))return M("p",{},"No output deviates from the motion with all drive flanks in contact.");let n=t.run.deviations.map(s=>{let r=t.pointers.findIndex(({output:a})=>a===s.output),o=M("td",{class:"number"});return r<0||t.movement.kind==="mean"?o.textContent="–":this.leads.push({now:o,ahead:()=>e.aheadBy(r)}),M("tr",{"data-lead":s.output},M("th",{scope:"row"},s.output),o,M("td",{class:"number"},Dl(qr(s.ahead))),M("td",{class:"number"},Dl(qr(s.behind))))});return M("div",{class:"scroll"},M("p",{},"Outputs relative to the motion with all drive flanks in contact:"),M("table",{class:"outputs"},M("thead",{},M("tr",{},["output","ahead now","maximum ahead","maximum behind"].map(s=>M("th",{scope:"col"},s)))),M("tbody",{},n)))}set(t){if(!(!t||!this.node.offsetParent)){for(let{now:e,state:n}of this.rows){let s=n();e.textContent=Xb[s],e.dataset.state=s}for(let{now:e,ahead:n}of this.leads)e.textContent=Dl(qr(n(),ru))}}},qr=(i,t=1e-7)=>Math.abs(i)<t?0:i,ou=(i,t)=>M("li",{},M("span",{class:`swatch ${i}`}),t);function $b({driven:i,link:t,torque:e,rate:n,skip:s}){let r={rate:"kept at constant speed",torque:"driven by a torque or a weight",spring:"driven by a spring",hand:"driven by a hand of finite stiffness"}[i],o=s?` The first ${Nl(s)} s are omitted.`:"";return`${t} is ${r}: mean speed of the input ${su(n)}, torque ${Nl(1e3*e)} N mm.${o}`}function Yb(i,t){return t.pairs.map(e=>{let n=i.pairs.find(r=>r.id===e);if(n){let r=n.wheels.map(o=>i.wheels[o]);return{id:e,words:r.map(o=>`${o.id} (${o.teeth})`).join(" with "),text:n.text,wheel:n.wheels[0]}}let s=i.couplings.find(r=>r.id===e);return{id:e,words:s?s.kind.replaceAll("_"," "):e,text:s?.text??"",wheel:null}})}var Ul=class{constructor({onPair:t,onClose:e}){this.onPair=t,this.onClose=e,this.node=M("section",{class:"path",hidden:!0,"aria-label":"path"})}show(t,e){let n=M("button",{type:"button",class:"small",onclick:()=>this.onClose()},"Clear path"),s=M("div",{class:"row"},M("h3",{},`${Zb(e[0])} to ${t}`),n);this.node.replaceChildren(s,...e.flatMap(r=>this.#t(r,e.length>1))),this.node.hidden=!1}#t({side:t,pointer:e},n){let s=Yb(t.scene,e),r=t.scene.bodies[e.base],o=[e.text,r?.parent!=null&&`relative to ${r.id}`,e.note].filter(Boolean).join("; ");return[M("p",{class:"quiet"},n&&`${t.label}: `,o),s.length?M("ol",{class:"steps","data-side":t.label},s.map(a=>this.#e(t,a))):M("p",{class:"quiet"},"There are no pairs on the path.")]}#e(t,{id:e,words:n,text:s,wheel:r}){let a=r===null?n:M("button",{type:"button",class:"plain",onclick:()=>this.onPair(t,r)},n);return M("li",{"data-pair":e,title:s},a)}hide(){this.node.hidden=!0,this.node.replaceChildren()}},Zb=({side:{scene:i}})=>`From ${i.driving_link===null?"the input":i.bodies[i.driving_link].id}`;var Fl=class{constructor(t,e){this.panels=t.map(s=>{let[r,o]=[Vh("tab"),Vh("page")];return{...s,tab:M("button",{type:"button",role:"tab",id:r,"aria-controls":o,onclick:()=>this.show(s.name)},s.name),page:M("div",{role:"tabpanel",id:o,tabindex:0,"aria-labelledby":r,class:"page","data-page":s.name},s.node)}});let n=M("div",{role:"tablist","aria-label":e},this.panels.map(s=>s.tab));n.addEventListener("keydown",s=>this.#t(s)),this.list=n,this.node=M("div",{class:"tabs"},n,M("div",{class:"pages"},this.panels.map(s=>s.page))),this.show(t[0].name)}#t(t){let e={ArrowRight:1,ArrowDown:1,ArrowLeft:-1,ArrowUp:-1}[t.key],n=this.panels.findIndex(o=>o.name===this.current),s=this.panels.length-1,r=e?(n+e+s+1)%(s+1):{Home:0,End:s}[t.key];r!==void 0&&(t.preventDefault(),t.stopPropagation(),this.show(this.panels[r].name),this.panels[r].tab.focus())}show(t){this.current=t;for(let e of this.panels){let n=e.name===t;e.tab.setAttribute("aria-selected",String(n)),e.tab.tabIndex=n?0:-1,e.page.hidden=!n}this.onShow?.(t)}};var Jb={surviving:"surviving",reconstructed:"reconstructed",hypothetical:"hypothetical"},Kb=i=>`${(i*100).toPrecision(3)} % of the input power`;function jb(i,t,e,n=null){let s=i.bodies[t.body],r=i.sources[t.source],o=i.pairs.filter(l=>t.circuits.includes(l.id)),a=s.shown===null?[["Speed","not determined"]]:[["Speed, exact",zs(s.shown,e)],["Speed, decimal",`${Nn(s.decimal)}${i.unit&&!s.travels?` ${i.unit}`:""}`]];return[["Teeth",n??zs(String(t.teeth),e)],["Uncertain",t.doubt],["Kind",t.kind],["On",`${s.id}${s.role==="arbor"?"":` (${s.role})`}`],["Status",Jb[t.status]??"not stated"],...a,["",s.bookkeeping?"sum over joints that are not parallel, not a rotation":""],["Circuits",o.length?M("ul",{},o.map(l=>M("li",{class:l.broken&&"bad"},`${l.id}, carried by ${i.bodies[l.carrier]?.id??"nothing"}: ${l.text}`))):"no meshes"],["Loss",t.loss===null||t.loss===void 0?"":Kb(t.loss)],["Note",t.note],["Source",t.source&&M("span",{},`${t.source}${r?.cite?`: ${r.cite}`:""} `,r?.url&&ul(r.url))]].filter(([,l])=>l!==""&&l!==null&&l!==void 0)}var Bl=class{constructor(t,{onSelect:e,onCounts:n,say:s}){this.sides=t,this.onCounts=n,this.onSelect=e,this.say=s,this.items=[],this.detail=M("section",{class:"detail",hidden:!0,"aria-label":"wheel",tabindex:-1}),this.search=M("input",{type:"search",placeholder:"Find a wheel","aria-label":"find a wheel",oninput:()=>this.#e()}),this.none=M("p",{class:"quiet",hidden:!0},"No wheel has this name."),this.node=M("div",{},this.detail,this.search,this.none,t.map(r=>this.#t(r)))}#t(t){let e=t.scene.wheels.map((n,s)=>{let r=M("button",{type:"button","aria-pressed":"false","data-wheel":n.id,onclick:()=>this.onSelect(t,s)},M("span",{},n.id),M("span",{class:"quiet"},`${n.teeth}${n.doubt?" ?":""}`)),o=eu(t,s,this.onCounts,"list"),a=M("li",{class:t.steps.some(c=>c.wheel===n.id)&&"stepped"},r,o),l=`${n.id} ${n.teeth} ${t.scene.bodies[n.body].id} ${n.status}`.toLowerCase();return this.items.push({side:t,index:s,item:a,button:r,text:l}),a});return[this.sides.length>1&&M("h3",{},t.label),M("ul",{class:t.formulas?"wheels stepped":"wheels"},e)]}#e(){let t=this.search.value.trim().toLowerCase();for(let e of this.items)e.item.hidden=!e.text.includes(t);this.none.hidden=this.items.some(e=>!e.item.hidden)}show(t,e){for(let r of this.items)r.button.setAttribute("aria-pressed",String(r.side===t&&r.index===e));let n=this.detail.contains(document.activeElement);if(this.detail.hidden=e===null,n&&e===null&&this.before?.focus(),this.before=this.items.find(r=>r.side===t&&r.index===e)?.button,this.detail.replaceChildren(),e===null)return;let s=t.scene.wheels[e];this.detail.append(M("div",{class:"row"},M("h3",{},`Wheel ${s.id}`),M("button",{type:"button",class:"small",onclick:()=>this.onSelect(t,null)},"Close")),M("dl",{},jb(t.scene,s,this.say,eu(t,e,this.onCounts,"one",!0)).map(([r,o])=>[M("dt",{},r),M("dd",{},o)])))}};var kl=class{constructor(t){this.owner=t;let n=["Readings","Wheels",t.all.some(({formulas:s})=>s)&&"Change","About"].filter(Boolean);t.all.some(({machine:s})=>s.run)&&n.unshift("Contacts"),this.places=Object.fromEntries(n.map(s=>[s,M("div",{})])),this.way=new Ul({onPair:(s,r)=>t.select(s,r),onClose:()=>t.letGo()}),this.tabs=new Fl(Object.entries(this.places).map(([s,r])=>({name:s,node:r})),"panels"),this.tabs.onShow=()=>this.open(!0),addEventListener("beforeprint",()=>this.#t(!0)),matchMedia("print").addEventListener("change",({matches:s})=>this.#t(s)),this.grip=M("button",{type:"button",class:"grip","aria-expanded":"false","aria-controls":"panel",onclick:()=>this.open(!this.node.classList.contains("open"))},"Open panels"),this.node=M("aside",{class:"panel",id:"panel",tabindex:-1,"aria-label":"panels"},this.grip,this.way.node,this.tabs.node)}open(t){let e=t&&this.grip.offsetParent&&!this.node.classList.contains("open");this.node.classList.toggle("open",t),e&&document.querySelector(".views")?.scrollIntoView(),this.grip.setAttribute("aria-expanded",String(t)),this.grip.textContent=t?"Close panels":"Open panels",t&&this.readings&&this.set(!0)}use(t){let e=l=>this.owner.live.say(l),n=l=>this.owner.choose(l),s=l=>this.owner.setTo(l),r=this.readings?.comparison?.open;this.readings=new Tl(t,{onChoose:n,onSet:s,say:e}),r&&this.readings.comparison&&(this.readings.comparison.open=!0);let o=(l,c)=>this.owner.count(l,c);this.wheels=new Bl(t,{onSelect:(l,c)=>this.owner.select(l,c),onCounts:o,say:e}),this.change=new Al(t,{onCounts:o,say:e}),this.chosen=null,this.contacts=new Ol(t,(l,c)=>this.owner.contact(l,c)),this.places.Contacts?.replaceChildren(this.contacts.node),this.places.Readings.replaceChildren(this.readings.node),this.places.Wheels.replaceChildren(this.wheels.node),this.places.Change?.replaceChildren(this.change.node);let a=M("p",{class:"quiet for-fingers"},nu);this.places.About.replaceChildren(a,...t.map(l=>Hp(l,t.length>1)))}set(t){this.readings.set(t),this.contacts.set(t)}#t(t){for(let e of this.owner.sides)e.print(t);if(t){for(let e of this.node.querySelectorAll(".more"))e.open=!0;this.set(!0)}}showChange(){this.tabs.show("Change")}wheel(t,e){this.wheels.show(t,e);let n=this.chosen?.[1]===e;this.chosen=e===null?null:[t,e],!n&&(e!==null&&this.tabs.show("Wheels"),e!==null&&this.wheels.detail.scrollIntoView({block:"nearest"}))}path(t,e){this.way.show(t,e),this.readings.mark(t),this.open(!0)}find(){this.tabs.show("Wheels"),this.wheels.search.focus(),this.wheels.search.select()}letGo(){let t=this.way.node.contains(document.activeElement);this.way.hide();let e=this.readings.mark(null);t&&e?.focus()}};function au(i){let t=i.map(r=>r.canvas),e=document.createElement("canvas");e.width=t.reduce((r,{width:o})=>r+o,0),e.height=Math.max(...t.map(({height:r})=>r));let n=e.getContext("2d"),s=0;return i.forEach((r,o)=>{r.render(),n.drawImage(t[o],s,0),s+=t[o].width}),e}var Yp=i=>new Promise(t=>au(i).toBlob(t,"image/png")),Qb=["fill","fill-opacity","fill-rule","stroke","stroke-width","stroke-linejoin","vector-effect","opacity","display","text-anchor","font-family"];function Zp(i){let[t,e]=[0,0],n=i.map(({canvas:o})=>{let a=o.cloneNode(!0),l=[o,...o.querySelectorAll("*")];[a,...a.querySelectorAll("*")].forEach((u,d)=>{let f=getComputedStyle(l[d]);for(let m of Qb)u.style.setProperty(m,f.getPropertyValue(m))});let{width:c,height:h}=o.getBoundingClientRect();for(let[u,d]of Object.entries({x:t,y:0,width:c,height:h}))a.setAttribute(u,d);return[t,e]=[t+c,Math.max(e,h)],a}),s=getComputedStyle(i[0].canvas.parentElement).backgroundColor,r=Gt("svg",{width:t,height:e},Gt("rect",{width:"100%",height:"100%",fill:s}),...n);return new Blob([new XMLSerializer().serializeToString(r)],{type:"image/svg+xml"})}var tS=.62,eS=12,[nS,iS]=[.24,.2],zl=(i,t)=>i.findIndex(({id:e})=>e===t);function Jp(i){return i.dials.length?sS(i):rS(i)}function sS(i){return i.pointers.flatMap(({output:t,body:e,dial:n,level:s},r)=>{if(n===null||Fr(i,r)!==r)return[];let{look:o,centre:a,normal:l,zero:c,radius:h,scale:u}=i.dials[n],d=o==="ball",f=d?0:h*(u.turns>1?u.inner:tS*u.outer),m=G(a).addScaledVector(G(c),f).addScaledVector(G(l),d?0:s),x=g=>g.placed(m,d?g.poses.ball(n):e,G(a)),p=g=>d||g.clone().sub(G(a)).dot(G(l))>0;return[{name:t,order:Ls(i,r),at:x,faces:p}]})}function rS(i){let t=new Map;i.wheels.forEach(s=>{let r=t.get(s.body);(!r||li(s)>li(r))&&t.set(s.body,s)});let e=new Set([i.driving_link,...i.pointers.map(({body:s})=>s)]);return[...t.values()].sort((s,r)=>e.has(r.body)-e.has(s.body)||li(r)-li(s)).slice(0,eS).map(s=>{let{id:r,parent:o}=i.bodies[s.body],a=l=>{let c=G(s.direction).transformDirection(l.nodes[s.body].matrixWorld),h=G([0,1,0]).addScaledVector(c,-c.y);return l.placed(G(s.centre),s.body).addScaledVector(h.normalize(),.9*s.radius)};return{name:o===null?s.id:r,order:null,at:a,faces:()=>!0}})}function Kp(i,{kind:t,name:e}){let{scene:n}=i,s=t==="output"?n.pointers.find(({output:l})=>l===e):null,r=t==="dial"?zl(n.dials,e):s?.dial??-1;if(r>=0)return oS(i,r);if(t==="wheel"){let l=n.wheels[zl(n.wheels,e)];return{points:ja(n,l).flatMap(Ln),towards:null,chosen:{wheels:[n.wheels.indexOf(l)]}}}let o=n.couplings[zl(n.couplings,e)],a=t==="coupling"?o?[o.pin,o.slot]:[]:[s?.body??zl(n.bodies,e)];return{points:aS(i,a),towards:null,chosen:{bodies:a}}}function oS(i,t){let{body:e,centre:n,normal:s,radius:r}=i.scene.dials[t],o=i.placed(G(n),e),a=G(s).addScaledVector(G([0,1,0]),nS).addScaledVector(G([Math.sign(s[2])||1,0,0]),iS);return{points:Ln({at:o,direction:s,radius:1.1*r}),towards:a.normalize(),chosen:null}}function aS(i,t){let e=({body:r})=>t.includes(r),n=Yi(i.scene).filter(e).flatMap(Ln);if(n.length)return n;let s=i.corners.filter(e).map(({point:r,body:o})=>i.placed(r,o));return s.length?s:i.outline()}var[Vl,Gl]=[10,19],Vs=class{constructor(t){this.stage=t,this.node=Gt("svg",{class:"callouts","aria-hidden":"true"}),t.onDraw=()=>this.#e()}show(t){this.shown=t,this.node.toggleAttribute("hidden",!t),t&&this.stage.request()}#t(t){this.world=t,this.labels=Jp(t.scene).map(e=>{let n=Gt("text",{},e.name),s=Gt("path",{}),r=Gt("g",{class:e.order===null?"":`hand-${e.order%en.length}`},s,n);return{...e,text:n,way:s,group:r}}),this.node.replaceChildren(...this.labels.map(({group:e})=>e))}#e(){let{world:t,camera:e,width:n,height:s}=this.stage;if(!this.shown||!this.node.isConnected)return;this.world!==t&&this.#t(t);let r=this.labels.map(l=>{let c=l.faces(e.position)?l.at(t).project(e):null;return c&&Math.abs(c.x)<1&&Math.abs(c.y)<1?{label:l,x:(c.x+1)/2*n,y:(1-c.y)/2*s}:null});this.labels.forEach(({group:l},c)=>l.toggleAttribute("hidden",!r[c]));let o=r.filter(Boolean).sort((l,c)=>l.x-c.x),a=Math.ceil(o.length/2);this.#n(o.slice(0,a),!1),this.#n(o.slice(a),!0)}#n(t,e){let{width:n,height:s}=this.stage;t.sort((a,l)=>a.y-l.y);let r=Gl;for(let a of t)r=(a.place=Math.max(a.y,r))+Gl;let o=s-Gl/2;for(let a of t.toReversed())o=(a.place=Math.min(a.place,o))-Gl;for(let{label:a,x:l,y:c,place:h}of t){a.long||=a.text.getComputedTextLength();let[u,d]=e?[n-Vl,n-Vl-a.long-5]:[Vl,Vl+a.long+5];a.text.setAttribute("x",u),a.text.setAttribute("y",h.toFixed(1)),a.text.setAttribute("text-anchor",e?"end":"start"),a.way.setAttribute("d",`M${d.toFixed(1)} ${(h-4).toFixed(1)}L${l.toFixed(1)} ${c.toFixed(1)}`)}}};var lS="A plan is shown, because this browser has no 3D graphics (WebGL). Everything else works.",Hl=class{constructor(t,e){this.app=t,this.index=e,this.scene=t.scenes[e],this.machine=t.machines[e],this.declared=this.scene,this.declaredMachine=this.machine,this.formulas=this.scene.formulas?new bl(this.scene):null,this.counts=this.formulas?.declared??[],this.stage=null,this.label=t.options?.compare?this.scene.name:this.scene.state??this.scene.name,this.machine.run&&(this.label=[this.scene.state,this.machine.simulated?"simulated":"drive flanks in contact"].filter(Boolean).join(", ")),this.legend=M("div",{}),this.place=M("div",{}),this.nothing=M("p",{class:"nothing",hidden:!0},lS);let n=M("figcaption",{},M("span",{class:"caption"},this.label),this.nothing,this.legend);this.figure=M("figure",{class:"view",hidden:!0},this.place,n)}open(){if(this.stage)return!1;this.stage=this.app.open(this.index);let{canvas:t}=this.stage;return this.nothing.hidden=t instanceof HTMLCanvasElement,this.callouts=this.stage.renderer?new Vs(this.stage):null,this.place.replaceChildren(...[t,this.callouts?.node].filter(Boolean)),this.#t(t),!0}#t(t){t.setAttribute("tabindex","0"),t.setAttribute("role","img"),t.setAttribute("aria-label",`${this.label}, animated picture; the wheels are listed under Wheels`)}print(t){this.copy?.remove(),this.copy=t&&this.stage?.renderer?au([this.stage]):null,this.copy?.classList.add("copy"),this.copy&&this.place.append(this.copy)}close(){this.stage&&(this.app.close(this.index),this.stage=null,this.place.replaceChildren())}change(t){this.counts=t;let{turns:e}=this.machine;this.scene=this.steps.length?this.formulas.changed(t):this.declared,this.day&&(this.scene=vl(this.scene,this.day)),this.machine=this.scene===this.declared?this.declaredMachine:new fi(this.scene),this.machine.turns=e,this.app.scenes[this.index]=this.scene,this.app.machines[this.index]=this.machine}setTo(t){this.day=t,this.change(this.counts)}redraw(t){clearTimeout(this.drawing),this.drawing=setTimeout(()=>{this.stage&&(this.stage.rebuild(this.machine),t(this.stage))},150)}get steps(){if(!this.formulas)return[];let{given:t,declared:e}=this.formulas;return t.wheels.flatMap((n,s)=>{if(this.counts[s]===e[s])return[];let{body:r}=this.declared.wheels[t.count.indexOf(s)];return[{wheel:n,link:this.declared.bodies[r].id,declared:e[s],count:this.counts[s]}]})}get meshes(){return this.formulas.meshes(this.counts)}get movable(){return this.scene.movement.kind!=="still"&&this.scene.driving_link!==null}get#e(){let{step:t,unit:e,unit_days:n,run:s}=this.scene;if(s)return{name:"seconds of a run",size:nt.of(s.period)};let r=nt.parse(t);return!r||r.numerator===0n||!e?null:n?{name:"days",size:nt.of(n).over(r)}:{name:e,size:nt.of(1).over(r)}}gearing(t){let[e,n]=[this.#e,t.#e];return e&&n&&e.name===n.name?n.size.over(e.size):nt.of(1)}get lead(){return this.scene.driving_link===null?"the input":this.scene.bodies[this.scene.driving_link].id}beside(t){let e=this.gearing(t);return e.equals(1)&&this.lead===t.lead?"":`${Fs(e)} of ${this.lead} beside for each`}};var cS={system:"System",light:"Light",dark:"Dark"},Gs=class{constructor(t){this.onChange=t,this.system=matchMedia("(prefers-color-scheme: dark)"),this.system.addEventListener("change",()=>this.apply()),this.select=M("select",{"aria-label":"theme",onchange:()=>this.apply()},Object.entries(cS).map(([e,n])=>M("option",{value:e},n)))}apply(){let t=this.select.value,e=t==="dark"||t==="system"&&this.system.matches;document.documentElement.dataset.theme=e?"dark":"light",this.onChange(this.background)}get background(){return getComputedStyle(document.documentElement).getPropertyValue("--stage").trim()}};var cu={plain:"Brass",speed:"Speed",status:"Status",loss:"Loss"};function jp(i,t,e){let n=M("span",{class:i,"aria-hidden":"true"});return n.style.background=t,M("li",{},n,e)}var Qp=(i,t)=>jp("swatch",i,t),lu=(i,t,e)=>jp("swatch ramp",`linear-gradient(90deg, ${i}, ${t})`,e);function hS(i){let t=["clockwise","counter-clockwise"],[e,n]=i.positive==="clockwise"?t:t.reverse(),s=r=>[Ur(r*1e-6,1),Ur(r,1)];return[lu(...s(1),`${e}, slow to fast`),lu(...s(-1),`${n}, slow to fast`),Qp(Ur(0,1),"at rest")]}function uS(i){let t=e=>i.wheels.filter(n=>(n.status in Or?n.status:"")===e).length;return Object.entries(Or).filter(([e])=>t(e)).map(([e,n])=>Qp(n,`${e||"not stated"} (${t(e)})`))}function dS(i){if(!i.wheels.some(n=>typeof n.loss=="number"))return[M("li",{},"No losses, because the train declares no loads or friction.")];let e=`power loss at the meshes: 0 to ${(Math.max(...i.wheels.map(n=>n.loss??0))*100).toPrecision(2)} % of the input power`;return[lu(al(0,1),al(1,1),e)]}function $r(i,t){let e={speed:hS,status:uS,loss:dS}[t]?.(i)??[];return M("ul",{class:"legend","aria-label":"legend",hidden:!e.length},e)}async function tm(i){let t=i.filter(({stage:o})=>o),e=t.filter(({stage:o})=>o.renderer),n=e.length?e:t;if(!n.length)return;let s=n.map(({stage:o})=>o),r=n.map(({scene:o})=>o.name);uu(e.length?await Yp(s):Zp(s),hu(r,e.length?"png":"svg"))}function hu(i,t){return`${[...new Set(i.filter(Boolean))].join("-").replace(/[^\w.+-]+/g,"-")}.${t}`}function uu(i,t){let e=URL.createObjectURL(i),n=document.createElement("a");n.href=e,n.download=t,n.click(),setTimeout(()=>URL.revokeObjectURL(e),1e4)}var fS=30,pS="M12 5a7 7 0 1 0 0 14a7 7 0 0 0 0-14z",mS="M6 6h12v12H6z",gS=["video/webm;codecs=vp9","video/webm;codecs=vp8","video/webm"];function _S(){return!HTMLCanvasElement.prototype.captureStream||!globalThis.MediaRecorder?null:gS.find(i=>MediaRecorder.isTypeSupported(i))??null}var Wl=class{constructor(){this.type=_S(),this.recorders=[],this.node=M("button",{type:"button",class:"record","aria-label":"Record film","aria-pressed":"false",title:"Record film",onclick:()=>this.toggle()}),this.use([])}use(t){this.stop(),this.sides=t.filter(({stage:e})=>e?.renderer),this.node.hidden=!this.type||!this.sides.length}toggle(){this.recorders.length?this.stop():this.start()}start(){this.recorders=this.sides.map(t=>this.#t(t)),this.#e(!0)}#t({scene:t,stage:e}){let n=e.canvas.captureStream(fS),s=new MediaRecorder(n,{mimeType:this.type}),r=[];return s.addEventListener("dataavailable",({data:o})=>r.push(o)),s.addEventListener("stop",()=>{for(let o of n.getTracks())o.stop();uu(new Blob(r,{type:"video/webm"}),hu([t.name,t.state],"webm"))}),s.start(),e.request(),s}stop(){for(let t of this.recorders)t.state!=="inactive"&&t.stop();this.recorders=[],this.#e(!1)}#e(t){this.node.setAttribute("aria-pressed",String(t)),this.node.replaceChildren(mn(t?mS:pS))}};var xS="(max-width: 820px), (max-height: 520px)",yS={front:"Front",back:"Back",side:"Side",free:"Free"},Xl=class{constructor(t){this.sides=[],this.mode="plain",this.looking="free",this.looks=Object.entries(yS).map(([e,n])=>M("button",{type:"button","data-look":e,"aria-pressed":"false",onclick:()=>this.look(e)},n)),this.colour=M("select",{"aria-label":"Colours",onchange:()=>this.paint(this.colour.value)},Object.entries(cu).map(([e,n])=>M("option",{value:e},n))),this.apart=M("input",{type:"range",min:0,max:1,step:.01,value:0,oninput:()=>this.#i()}),this.front=M("input",{type:"checkbox",onchange:()=>this.#n(e=>e.hideFront(this.front.checked))}),this.teeth=M("input",{type:"checkbox",onchange:()=>this.#n(e=>e.showTeeth(this.teeth.checked))}),this.open=M("input",{type:"checkbox",onchange:()=>this.#r(this.wanted=this.open.checked)}),this.names=M("input",{type:"checkbox",onchange:()=>this.#s()}),this.status=M("button",{type:"button","aria-pressed":"false",onclick:()=>this.paint(this.mode==="status"?"plain":"status")},"Status"),this.opening=Fe("Cut open",this.open,{class:"field tick"}),this.recording=new Wl,this.teeth.checked=t?.teeth!==!1,this.row=M("div",{class:"tools",role:"group","aria-label":"picture"},M("div",{class:"group",role:"group","aria-label":"view from"},this.looks),this.colour,this.status,Fe("Apart",this.apart),Fe("Hide front",this.front,{class:"field tick"}),Fe("Names",this.names,{class:"field tick"}),Fe("Teeth",this.teeth,{class:"field tick"}),this.opening),this.files=M("div",{class:"group",role:"group","aria-label":"files"},M("button",{type:"button",class:"save","aria-label":"Save picture",onclick:()=>tm(this.sides)},"Save"),this.recording.node),this.node=M("details",{class:"fold"},M("summary",{},"Picture"),this.row),this.small=matchMedia(xS),this.names.checked=!this.small.matches,this.#t(()=>this.node.open=!this.small.matches)}#t(t){this.small.addEventListener("change",t),t()}lodge(t,e){this.#t(()=>(this.small.matches?this.row:t).append(...e,this.files))}use(t){this.sides=t,this.recording.use(t);let e=t.flatMap(({stage:n})=>n??[]);this.opening.hidden=!e.some(n=>n.canOpen),this.open.checked=this.wanted??e.some(n=>n.world?.opened),this.#n(n=>{n.onOrbit=()=>this.#e(null),n.hideFront(this.front.checked),n.showTeeth(this.teeth.checked)}),this.status.hidden=!t.some(({scene:n})=>n.wheels.some(({status:s})=>s)),this.#s(),this.wanted!==void 0&&this.#r(this.wanted),this.#i(),this.look(this.looking),this.paint(this.mode)}dress(t,e){e.hideFront(this.front.checked),e.showTeeth(this.teeth.checked),e.explode(Number(this.apart.value)),e.paint(this.mode),t.legend.replaceChildren($r(t.scene,this.mode))}#e(t){for(let e of this.looks)e.setAttribute("aria-pressed",String(e.dataset.look===t))}#n(t){for(let e of this.sides)e.stage&&t(e.stage)}#s(){for(let{callouts:t}of this.sides)t?.show(this.names.checked)}#r(t){this.#n(e=>e.cutOpen?.(t))}#i(){this.apart.setAttribute("aria-valuetext",`${Math.round(this.apart.value*100)} %`),this.#n(t=>t.explode(Number(this.apart.value)))}look(t){this.looking=t,this.#e(t),this.#n(e=>e.look(t))}paint(t){this.mode=t,this.colour.value=t,this.status.setAttribute("aria-pressed",String(t==="status"));for(let e of this.sides)e.legend.replaceChildren($r(e.scene,t));this.#n(e=>e.paint(t))}next(){let t=Object.keys(cu);this.paint(t[(t.indexOf(this.mode)+1)%t.length])}toggle(t){t.checked=!t.checked,t.dispatchEvent(new Event("change"))}assemble(){this.apart.value=0,this.#i()}takeApart(){this.apart.value=Number(this.apart.value)>0?0:1,this.#i()}};var Ki=class{constructor(t,e){Object.assign(this,{steps:t,onStep:e,at:-1});let n=(s,r)=>M("button",{type:"button",onclick:()=>this.go(this.at+r)},s);this.first=n(`Tour in ${t.length} steps`,1),[this.back,this.next]=[n("Back",-1),n("Next",1)],this.end=M("button",{type:"button",onclick:()=>this.go(-1)},"End"),this.text=M("p",{"aria-live":"polite"}),this.buttons=M("div",{class:"buttons"},this.back,this.next,this.end),this.node=M("section",{class:"tour","aria-label":"tour",hidden:!t.length},this.first,this.text,this.buttons),this.#t()}go(t){this.at=t<this.steps.length?t:-1,this.#t(),this.onStep(this.steps[this.at]??null)}#t(){let t=this.steps[this.at];this.first.hidden=!!t,this.text.hidden=this.buttons.hidden=!t,this.back.disabled=this.at===0,this.text.textContent=t?`${this.at+1}/${this.steps.length} ${t.text}`:""}};var vS=100,du=class{constructor(t){this.app=t,this.all=t.scenes.map((n,s)=>new Hl(t,s));let e=this.all[0].scene;this.drive=new ks(t,nt.of(e.step)),this.drive.rate=pl(e),t.machines[0].moves&&(this.drive.at=ml(e)),this.live=new Pl,this.tools=new Xl(t.options),this.theme=new Gs(n=>this.all.forEach(({stage:s})=>s?.theme({background:n}))),this.theme.apply(),this.crank=new zr(e,this.drive,{set:n=>this.setTo(n)}),this.keys=new Cl({timed:this.all.some(({machine:n})=>n.run),drive:this.drive,tools:this.tools,goTo:()=>this.crank.find(),find:()=>this.panel.find(),back:()=>this.crank.turnBack?.(),escape:()=>this.letGo()}),this.head=new Rl(this.all,{compare:!!t.options?.compare,theme:this.theme.select,onKeys:()=>this.keys.open(),onChanged:()=>this.panel.showChange(),onShow:n=>this.show(n),onLoop:(n,s)=>this.loop(n,s),onElement:(n,s)=>this.element(n,s)}),this.tools.lodge(this.head.choices,this.head.rest),this.panel=new kl(this),this.tour=new Ki([],()=>{}),this.#t(),this.drive.listen((n,s)=>this.#e(n,s)),this.show(this.head.sides)}#t(){let t=M("div",{class:"views"},this.all.map(e=>e.figure));document.body.prepend(M("a",{class:"skip",href:"#panel"},"Skip to the panels"),M("div",{class:"house"},this.head.node,M("main",{class:"hall"},this.tools.node,t,this.tour.node,this.crank.node),this.panel.node),this.live.node,this.keys.node)}#e(t,e){let n=performance.now(),s=e||n-(this.worded??0)>vS;s&&(this.worded=n),this.crank.set(t,e),this.panel.set(s),e&&this.live.rest(t)}show(t){this.sides=t;for(let e of this.all)e.figure.hidden=!t.includes(e),e.figure.hidden&&e.close();document.body.classList.toggle("beside",t.length>1),this.panel.use(t),this.live.use(t),this.#r(t),this.#n(t[0]),this.lit&&this.openStages(),this.letGo(),this.drive.goTo(this.drive.at),this.crank.set(this.drive,!0),this.panel.set(!0)}openStages(){for(let t of this.sides){if(!t.open())continue;let{stage:e}=t;e.theme({background:this.theme.background}),e.onPick=n=>this.select(t,n),e.onCrank=n=>this.drive.advance(n/Number(this.app.gears[t.index]),!0),this.lit&&e.cut()}this.tools.use(this.sides);for(let{stage:t}of this.sides)t?.resize();this.lit=!0}#n(t){let e=new Ki(t.scene.tour,n=>this.#s(t,n));this.tour.node.replaceWith(e.node),this.tour=e}#s({stage:t},e){this.tools.assemble(),t?.visit&&t.visit(e,this.#a,this.drive.calm.matches),e||this.tools.look("free")}begin(){this.drive.calm.matches||this.drive.play(!0)}#r(t){let[e,n]=t;this.drive.play(!1),this.drive.step=nt.of(e.scene.step),this.drive.run=e.machine.run??null,this.drive.movable=t.some(({movable:r})=>r),this.app.gears=this.all.map(r=>r===n?r.gearing(e):nt.of(1));let s=this.drive.run?new Ll(e,this.drive):new zr(e.scene,this.drive,{beside:n?.beside(e),set:r=>this.setTo(r)});this.crank.node.replaceWith(s.node),this.crank=s}select(t,e){for(let n of this.sides)n.stage?.select(n===t?e:null);this.panel.wheel(t,e),e!==null&&this.live.say(`wheel ${t.scene.wheels[e].id}, ${t.scene.wheels[e].teeth} teeth`)}count(t,e){let{name:n,formulas:s}=t.declared,r=o=>o.formulas&&o.declared.name===n&&String(o.formulas.given.wheels)===String(s.wheels);this.#i(this.all.filter(r),o=>o.change(e)),this.live.say(t.steps.map(({wheel:o,count:a})=>`${o} ${a} teeth`).join(", ")||"all as declared")}setTo(t){this.#i(this.all.filter(({scene:e})=>e.epoch?.settings.length),e=>e.setTo(t)),this.live.say("set to the sky")}#i(t,e){let n=document.activeElement?.dataset?.key,s=this.panel.chosen;for(let r of t)e(r),r.redraw(o=>this.tools.dress(r,o));this.drive.movable=this.sides.some(({movable:r})=>r),this.drive.movable||this.drive.play(!1),this.head.write(),this.panel.use(this.sides),this.live.use(this.sides),this.crank.use?.(this.sides[0].scene),s&&this.panel.wheel(...s),n&&document.querySelector(`[data-key="${CSS.escape(n)}"]`)?.focus({preventScroll:!0}),this.drive.goTo(this.drive.at),this.panel.set(!0)}choose(t){let e=this.sides.map(s=>({side:s,pointer:s.scene.pointers.find(r=>r.output===t)})).filter(({pointer:s})=>s),n=new Map(e.map(({side:s,pointer:r})=>[s,{wheels:r.wheels}]));this.#o(n),this.panel.path(t,e),this.live.say(`path to ${t}: ${e.map(({pointer:s})=>`${s.pairs.length} pairs`).join(", ")}`)}contact(t,e){let{name:n,kind:s}=t.scene.run.contacts[e],r=l=>l.findIndex(({id:c})=>c===n),o=t.scene.couplings[r(t.scene.couplings)],a=s==="pin"?[o.pin,o.slot]:[r(t.scene.bodies)];this.#o(new Map([[t,s==="pair"?{pairs:[n]}:{bodies:a}]])),this.live.say(`${n} is shown`)}element(t,{bodies:e,closed:n,text:s}){this.#o(new Map([[t,{bodies:e}]])),this.live.say(`${s}; it is ${n?"closed":"open"}`)}loop(t,e){this.#o(new Map([[t,e]]),sl),this.live.say(`the loop ${e.pairs.join(", ")} is shown in red`)}#o(t,e=this.#a){for(let n of this.sides)n.stage?.highlight(t.get(n)??null,e)}get#a(){return getComputedStyle(document.documentElement).getPropertyValue("--way").trim()}letGo(){this.#o(new Map),this.select(this.sides[0],null),this.panel.letGo()}};function em(i){i.interface=new du(i)}var fu=["free","front","side","back"],MS="M2 12c3-5 6.5-7 10-7s7 2 10 7c-3 5-6.5 7-10 7s-7-2-10-7zM12 9.5a2.5 2.5 0 1 0 0 5 2.5 2.5 0 0 0 0-5z",bS="M3 5h9l8 7-8 7H3zM8 12h.01",SS="M12 3a9 9 0 1 0 0 18c2 0 2-3 0-4s0-3 3-3h4c1-6-3-11-7-11zM8 9h.01M14 7h.01",wS="M12 3l9 4.5-9 4.5-9-4.5zM3 12l9 4.5 9-4.5M3 16.5l9 4.5 9-4.5",ES=45,TS=6,AS=90,Yr=class{static asked(t,e){let[,n,s]=/^#(embed|kiosk)(?:=(\d{1,5}))?$/.exec(t)??[null,e];return n!=="embed"&&n!=="kiosk"?null:{kiosk:n==="kiosk",idle:1e3*Math.max(1,Number(s??ES))}}constructor(t,{kiosk:e,idle:n}){Object.assign(this,{app:t,kiosk:e,idle:n}),this.index=Math.max(0,t.machines.findIndex(r=>r.moves)),this.scene=t.scenes[this.index],e&&this.scene.epoch?.settings.length&&this.#t();let{run:s}=t.machines[this.index];this.drive=new ks(t,nt.of(this.scene.step)),this.drive.run=s??null,this.drive.rate=s?iu(s)/s.period:pl(this.scene),this.drive.movable=t.machines[this.index].moves,this.drive.movable&&(this.drive.at=this.moment??ml(this.scene)),this.look=0,this.theme=new Gs(r=>this.stage?.theme({background:r})),this.theme.apply(),this.#e(),this.drive.listen(()=>this.#d()),this.drive.goTo(this.drive.at),e&&this.#f()}#t(){let t=yl();this.moment=Us(this.scene,t),this.scene=this.app.scenes[this.index]=vl(this.scene,t),this.app.machines[this.index]=new fi(this.scene)}#e(){let t=(h,u,d)=>M("button",{type:"button",onclick:h,"aria-label":u,title:u},mn(d),M("span",{},u));this.playing=t(()=>this.#r(),"Turn",Bs),this.playing.disabled=!this.drive.movable;let e=t(()=>this.#i(),"Other side",MS);this.apart=t(()=>this.#l(),"Take apart",wS),this.turns=M("output",{class:"quiet"}),this.place=M("div",{class:"place"});let{title:n,name:s,state:r,verdict:o,wheels:a}=this.scene,l=this.drive.movable?[this.turns,this.kiosk&&this.#n()]:M("p",{class:"bad"},o.text),c=this.kiosk&&[t(()=>this.callouts?.show(!this.callouts.shown),"Names",bS),a.some(({status:h})=>h)&&t(()=>this.#o(this.mode==="status"?"plain":"status"),"Status",SS)];this.tour=new Ki(this.kiosk?this.scene.tour:[],h=>this.#a(h)),this.legend=M("div",{}),document.body.classList.add("showcase"),document.body.classList.toggle("kiosk",this.kiosk),document.body.prepend(M("main",{},this.place,M("header",{},M("h1",{},n||s,r&&` (${r})`),this.kiosk&&M("p",{},gl(this.scene)),l,this.legend),this.tour.node,M("div",{class:"buttons",role:"group","aria-label":"the train"},this.playing,e,this.apart,c)))}#n(){let{scene:t,index:e,app:n}=this;t.epoch&&!t.epoch.unset.length&&(this.epoch=new Yn(t.epoch)),this.date=this.epoch&&M("output",{class:"date"});let r=(t.asks?t.pointers.map((a,l)=>l):[]).sort((a,l)=>(t.pointers[a].dial===null)-(t.pointers[l].dial===null));this.read=r.slice(0,TS).map(a=>({hand:new nn(t,n.machines[e],a),value:M("dd")}));let o=this.read.map(({hand:a,value:l})=>M("div",{class:a.dial&&`hand-${a.order%en.length}`},M("dt",{},a.pointer.output),l));return[this.date,M("dl",{class:"read"},o)]}openStages(){this.stage=this.app.open(this.index);let{canvas:t}=this.stage;t.setAttribute("role","img"),t.setAttribute("aria-label",`${this.scene.title||this.scene.name}, turning`),this.place.append(t),this.kiosk&&this.stage.renderer&&this.place.append((this.callouts=new Vs(this.stage)).node),this.stage.theme({background:this.theme.background}),this.stage.onCrank=e=>this.drive.advance(e,!0),this.stage.resize(),this.kiosk?this.#h():this.#s()}#s(){this.drive.calm.matches||new IntersectionObserver(t=>{let e=t.at(-1).isIntersecting;e&&!this.stopped?this.drive.play(!0):e||this.drive.play(!1)}).observe(this.place)}#r(){this.drive.play(),this.stopped=!this.drive.playing}#i(){this.look=(this.look+1)%fu.length,this.stage?.look(fu[this.look])}#o(t){this.mode=t,this.stage?.paint(t),this.legend.replaceChildren($r(this.scene,t))}#a(t){this.#l(!1);let e=getComputedStyle(document.documentElement).getPropertyValue("--way").trim();this.stage?.visit?.(t,e,this.drive.calm.matches)}#l(t=!this.pulled){this.pulled=t,this.#c(this.apart,t?"Together":"Take apart"),this.stage?.explode(t?1:0),this.stage?.look(fu[this.look])}#c(t,e){t.setAttribute("aria-label",e),t.title=e,t.querySelector("span").textContent=e}#d(){let{drive:t,scene:e}=this,n=e.bodies[e.driving_link]?.id??"the input";this.turns.textContent=t.run?`${t.time.toFixed(2)} s`:`${Fs(t.at,2)} turns of ${n}`,this.epoch&&(this.date.textContent=Zi(this.epoch.dateAt(nt.of(t.at)))),this.read?.forEach(({hand:s,value:r})=>r.textContent=Ns(s.now)),this.shown!==t.playing&&(this.shown=t.playing,this.#c(this.playing,t.playing?"Stop":"Turn"),this.playing.querySelector("svg").replaceWith(mn(t.playing?Vr:Bs)))}#f(){document.addEventListener("contextmenu",t=>t.preventDefault()),document.addEventListener("click",()=>{document.fullscreenElement||document.documentElement.requestFullscreen?.().catch(()=>{})});for(let t of["pointerdown","pointermove","wheel","keydown"])document.addEventListener(t,()=>this.#p(),{passive:!0,capture:!0})}#p(){this.alone=!1,clearTimeout(this.waiting),this.waiting=setTimeout(()=>this.#h(),this.idle)}#h(){this.alone=!0,this.look=0,this.tour.go(-1),this.#o("plain"),this.callouts?.show(!0),this.#l(!1),this.drive.play(!0),this.drive.calm.matches||this.#u(performance.now())}#u(t){requestAnimationFrame(e=>{let{controls:n}=this.stage;!this.alone||!n||(n.autoRotate=!0,n.autoRotateSpeed=60/AS,n.update(Math.min(e-t,100)/1e3),n.autoRotate=!1,this.#u(e))})}};var nm={type:"change"},mu={type:"start"},sm={type:"end"},ql=new kn,im=new We,RS=Math.cos(70*xh.DEG2RAD),Ce=new N,sn=2*Math.PI,ne={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},pu=1e-6,$l=class extends vr{constructor(t,e=null){super(t,e),this.state=ne.NONE,this.target=new N,this.cursor=new N,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:Ai.ROTATE,MIDDLE:Ai.DOLLY,RIGHT:Ai.PAN},this.touches={ONE:Ri.ROTATE,TWO:Ri.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new N,this._lastQuaternion=new ln,this._lastTargetPosition=new N,this._quat=new ln().setFromUnitVectors(t.up,new N(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new bs,this._sphericalDelta=new bs,this._scale=1,this._panOffset=new N,this._rotateStart=new It,this._rotateEnd=new It,this._rotateDelta=new It,this._panStart=new It,this._panEnd=new It,this._panDelta=new It,this._dollyStart=new It,this._dollyEnd=new It,this._dollyDelta=new It,this._dollyDirection=new N,this._mouse=new It,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=PS.bind(this),this._onPointerDown=CS.bind(this),this._onPointerUp=IS.bind(this),this._onContextMenu=BS.bind(this),this._onMouseWheel=NS.bind(this),this._onKeyDown=OS.bind(this),this._onTouchStart=US.bind(this),this._onTouchMove=FS.bind(this),this._onMouseDown=LS.bind(this),this._onMouseMove=DS.bind(this),this._interceptControlDown=kS.bind(this),this._interceptControlUp=zS.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(t){this._cursorStyle=t,t==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(t){super.connect(t),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=ne.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(t){t.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=t}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(nm),this.update(),this.state=ne.NONE}pan(t,e){this._pan(t,e),this.update()}dollyIn(t){this._dollyIn(t),this.update()}dollyOut(t){this._dollyOut(t),this.update()}rotateLeft(t){this._rotateLeft(t),this.update()}rotateUp(t){this._rotateUp(t),this.update()}update(t=null){let e=this.object.position;Ce.copy(e).sub(this.target),Ce.applyQuaternion(this._quat),this._spherical.setFromVector3(Ce),this.autoRotate&&this.state===ne.NONE&&this._rotateLeft(this._getAutoRotationAngle(t)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let n=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(n)&&isFinite(s)&&(n<-Math.PI?n+=sn:n>Math.PI&&(n-=sn),s<-Math.PI?s+=sn:s>Math.PI&&(s-=sn),n<=s?this._spherical.theta=Math.max(n,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(n+s)/2?Math.max(n,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(Ce.setFromSpherical(this._spherical),Ce.applyQuaternion(this._quatInverse),e.copy(this.target).add(Ce),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=Ce.length();o=this._clampDistance(a*this._scale);let l=a-o;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){let a=new N(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;let c=new N(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(a),this.object.updateMatrixWorld(),o=Ce.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(ql.origin.copy(this.object.position),ql.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(ql.direction))<RS?this.object.lookAt(this.target):(im.setFromNormalAndCoplanarPoint(this.object.up,this.target),ql.intersectPlane(im,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>pu||8*(1-this._lastQuaternion.dot(this.object.quaternion))>pu||this._lastTargetPosition.distanceToSquared(this.target)>pu?(this.dispatchEvent(nm),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(t){return t!==null?sn/60*this.autoRotateSpeed*t:sn/60/60*this.autoRotateSpeed}_getZoomScale(t){let e=Math.abs(t*.01);return Math.pow(.95,this.zoomSpeed*e)}_rotateLeft(t){this._sphericalDelta.theta-=t}_rotateUp(t){this._sphericalDelta.phi-=t}_panLeft(t,e){Ce.setFromMatrixColumn(e,0),Ce.multiplyScalar(-t),this._panOffset.add(Ce)}_panUp(t,e){this.screenSpacePanning===!0?Ce.setFromMatrixColumn(e,1):(Ce.setFromMatrixColumn(e,0),Ce.crossVectors(this.object.up,Ce)),Ce.multiplyScalar(t),this._panOffset.add(Ce)}_pan(t,e){let n=this.domElement;if(this.object.isPerspectiveCamera){let s=this.object.position;Ce.copy(s).sub(this.target);let r=Ce.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*t*r/n.clientHeight,this.object.matrix),this._panUp(2*e*r/n.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(t*(this.object.right-this.object.left)/this.object.zoom/n.clientWidth,this.object.matrix),this._panUp(e*(this.object.top-this.object.bottom)/this.object.zoom/n.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(t,e){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let n=this.domElement.getBoundingClientRect(),s=t-n.left,r=e-n.top,o=n.width,a=n.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(t){return Math.max(this.minDistance,Math.min(this.maxDistance,t))}_handleMouseDownRotate(t){this._rotateStart.set(t.clientX,t.clientY)}_handleMouseDownDolly(t){this._updateZoomParameters(t.clientX,t.clientY),this._dollyStart.set(t.clientX,t.clientY)}_handleMouseDownPan(t){this._panStart.set(t.clientX,t.clientY)}_handleMouseMoveRotate(t){this._rotateEnd.set(t.clientX,t.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(sn*this._rotateDelta.x/e.clientHeight),this._rotateUp(sn*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(t){this._dollyEnd.set(t.clientX,t.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(t){this._panEnd.set(t.clientX,t.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(t){this._updateZoomParameters(t.clientX,t.clientY),t.deltaY<0?this._dollyIn(this._getZoomScale(t.deltaY)):t.deltaY>0&&this._dollyOut(this._getZoomScale(t.deltaY)),this.update()}_handleKeyDown(t){let e=!1;switch(t.code){case this.keys.UP:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(sn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),e=!0;break;case this.keys.BOTTOM:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(-sn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),e=!0;break;case this.keys.LEFT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(sn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),e=!0;break;case this.keys.RIGHT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(-sn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),e=!0;break}e&&(t.preventDefault(),this.update())}_handleTouchStartRotate(t){if(this._pointers.length===1)this._rotateStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._rotateStart.set(n,s)}}_handleTouchStartPan(t){if(this._pointers.length===1)this._panStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panStart.set(n,s)}}_handleTouchStartDolly(t){let e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enablePan&&this._handleTouchStartPan(t)}_handleTouchStartDollyRotate(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enableRotate&&this._handleTouchStartRotate(t)}_handleTouchMoveRotate(t){if(this._pointers.length==1)this._rotateEnd.set(t.pageX,t.pageY);else{let n=this._getSecondPointerPosition(t),s=.5*(t.pageX+n.x),r=.5*(t.pageY+n.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(sn*this._rotateDelta.x/e.clientHeight),this._rotateUp(sn*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(t){if(this._pointers.length===1)this._panEnd.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panEnd.set(n,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(t){let e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(t.pageX+e.x)*.5,a=(t.pageY+e.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enablePan&&this._handleTouchMovePan(t)}_handleTouchMoveDollyRotate(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enableRotate&&this._handleTouchMoveRotate(t)}_addPointer(t){this._pointers.push(t.pointerId)}_removePointer(t){delete this._pointerPositions[t.pointerId];for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId){this._pointers.splice(e,1);return}}_isTrackingPointer(t){for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId)return!0;return!1}_trackPointer(t){let e=this._pointerPositions[t.pointerId];e===void 0&&(e=new It,this._pointerPositions[t.pointerId]=e),e.set(t.pageX,t.pageY)}_getSecondPointerPosition(t){let e=t.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[e]}_customWheelEvent(t){let e=t.deltaMode,n={clientX:t.clientX,clientY:t.clientY,deltaY:t.deltaY};switch(e){case 1:n.deltaY*=16;break;case 2:n.deltaY*=100;break}return t.ctrlKey&&!this._controlActive&&(n.deltaY*=10),n}};function CS(i){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(i.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(i)&&(this._addPointer(i),i.pointerType==="touch"?this._onTouchStart(i):this._onMouseDown(i),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function PS(i){this.enabled!==!1&&(i.pointerType==="touch"?this._onTouchMove(i):this._onMouseMove(i))}function IS(i){switch(this._removePointer(i),this._pointers.length){case 0:this.domElement.releasePointerCapture(i.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(sm),this.state=ne.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let t=this._pointers[0],e=this._pointerPositions[t];this._onTouchStart({pointerId:t,pageX:e.x,pageY:e.y});break}}function LS(i){let t;switch(i.button){case 0:t=this.mouseButtons.LEFT;break;case 1:t=this.mouseButtons.MIDDLE;break;case 2:t=this.mouseButtons.RIGHT;break;default:t=-1}switch(t){case Ai.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(i),this.state=ne.DOLLY;break;case Ai.ROTATE:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=ne.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=ne.ROTATE}break;case Ai.PAN:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=ne.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=ne.PAN}break;default:this.state=ne.NONE}this.state!==ne.NONE&&this.dispatchEvent(mu)}function DS(i){switch(this.state){case ne.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(i);break;case ne.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(i);break;case ne.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(i);break}}function NS(i){this.enabled===!1||this.enableZoom===!1||this.state!==ne.NONE||(i.preventDefault(),this.dispatchEvent(mu),this._handleMouseWheel(this._customWheelEvent(i)),this.dispatchEvent(sm))}function OS(i){this.enabled!==!1&&this._handleKeyDown(i)}function US(i){switch(this._trackPointer(i),this._pointers.length){case 1:switch(this.touches.ONE){case Ri.ROTATE:if(this.enableRotate===!1){this.state=ne.NONE;break}this._handleTouchStartRotate(i),this.state=ne.TOUCH_ROTATE;break;case Ri.PAN:if(this.enablePan===!1){this.state=ne.NONE;break}this._handleTouchStartPan(i),this.state=ne.TOUCH_PAN;break;default:this.state=ne.NONE}break;case 2:switch(this.touches.TWO){case Ri.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(i),this.state=ne.TOUCH_DOLLY_PAN;break;case Ri.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(i),this.state=ne.TOUCH_DOLLY_ROTATE;break;default:this.state=ne.NONE}break;default:this.state=ne.NONE}this.state!==ne.NONE&&this.dispatchEvent(mu)}function FS(i){switch(this._trackPointer(i),this.state){case ne.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(i),this.update();break;case ne.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(i),this.update();break;case ne.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(i),this.update();break;case ne.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(i),this.update();break;default:this.state=ne.NONE}}function BS(i){this.enabled!==!1&&i.preventDefault()}function kS(i){i.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function zS(i){i.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function gu(i,t,e,n,s){let r=G(e).cross(t);r.length()<1e-6&&r.set(1,0,0),r.normalize();let o=t.clone().cross(r),a=(f,m)=>{let x=S=>Math.max(...i.map(w=>S*w.dot(f)+m*w.dot(t))),[p,g]=[x(1),x(-1)];return{middle:(p-g)/2,away:(p+g)/(2*m)}},[l,c]=[a(r,n),a(o,s)],h=r.multiplyScalar(l.middle).addScaledVector(o,c.middle),u=i.map(f=>f.dot(t)),d=(Math.min(...u)+Math.max(...u))/2;return{target:h.addScaledVector(t,d),distance:Math.max(l.away,c.away)-d}}var VS=6,Yl=class{constructor(t){this.stage=t,this.ray=new yr,this.plane=new We,this.listeners={pointerdown:e=>this.down(e),pointermove:e=>this.move(e),pointerup:e=>this.up(e),pointercancel:()=>this.release()};for(let[e,n]of Object.entries(this.listeners))t.canvas.addEventListener(e,n,!0)}aim(t){let e=this.stage.canvas.getBoundingClientRect(),n=(t.clientX-e.left)/e.width*2-1,s=1-(t.clientY-e.top)/e.height*2;this.ray.setFromCamera(new It(n,s),this.stage.camera)}down(t){this.aim(t),this.from=[t.clientX,t.clientY],!(!this.stage.machine.moves||!this.onKnob())&&(this.dragged=this.crankAngle(),this.stage.controls.enabled=!1,this.stage.canvas.setPointerCapture(t.pointerId))}move(t){if(this.dragged===void 0)return;this.aim(t);let e=this.crankAngle();if(e===null)return;let n=this.dragged===null?0:e-this.dragged;this.dragged=e;let s=n-2*Math.PI*Math.round(n/(2*Math.PI)),r=this.stage.leadOf(s);r&&this.stage.onCrank(r)}up(t){let e=Math.hypot(t.clientX-this.from[0],t.clientY-this.from[1]);this.dragged===void 0&&e<=VS&&this.pick(t),this.release()}release(){this.dragged=void 0,this.stage.controls.enabled=!0}pick(t){this.aim(t),this.stage.onPick(this.stage.world.pick(this.ray.ray))}onKnob(){let{world:t}=this.stage,{crank:e}=t;return e!==null&&this.ray.ray.distanceToPoint(t.ofCrank(e.knob))<e.touch}crankAngle(){let{world:t,machine:e}=this.stage,n=e.scene.bodies[e.scene.crank],s=t.nodes[n.parent].matrixWorld,r=t.ofCrank(t.crank.at),o=G(n.direction).transformDirection(s);this.plane.setFromNormalAndCoplanarPoint(o,r);let a=this.ray.ray.intersectPlane(this.plane,G([0,0,0]));if(!a)return null;let[l,c]=[G([1,0,0]),G([0,1,0])],h=Math.abs(o.x)<.9?l:c;return h.addScaledVector(o,-h.dot(o)).normalize(),a.sub(r),Math.atan2(a.dot(o.clone().cross(h)),a.dot(h))}dispose(){for(let[t,e]of Object.entries(this.listeners))this.stage.canvas.removeEventListener(t,e,!0)}};var GS=["frame","carrier","wall","drum","post","pillar","foot"],rm=.001,om=(i,{kind:t,body:e})=>GS.includes(t)||t==="pin"&&i.wheels.some(n=>n.body===e&&n.kind==="ring");function am(i,t){let e=i.wheels.filter(({kind:m})=>m==="ring"),n=e.map(({body:m})=>i.bodies[m]),s=n.map(m=>e.filter((x,p)=>he(m.direction,n[p].direction)&&qn(m,n[p].point)<rm*t)),[r]=s.toSorted((m,x)=>x.length-m.length);if(!r)return null;let{point:o,direction:a}=i.bodies[r[0].body],l=G(a).multiplyScalar(i.front*Math.sign(a[2]||1)),c=he(a,[0,1,0])?G([0,0,-1]):G([0,1,0]),h=c.addScaledVector(l,-c.dot(l)).normalize(),u=r.map(({centre:m})=>G(m).dot(l)),f=i.parts.some(({kind:m})=>m==="wall")||Math.max(...u)-Math.min(...u)>rm*t;return{at:G(o),up:h,right:h.clone().cross(l),hides:f}}function lm({at:i,right:t,up:e},n){let s=n.clone().sub(i);return s.dot(t)>0&&s.dot(e)>0}var cm=8,HS=[.25,.6,.95],WS=.04;function hm({at:i,direction:t,radius:e,inner:n=0}){let[s,r]=[In(t),G(t)],o=r.clone().cross(s);return HS.flatMap(a=>{let l=n+a*(e-n);return Array.from({length:cm},(c,h)=>{let u=2*Math.PI*(h+a)/cm;return i.clone().addScaledVector(s,l*Math.cos(u)).addScaledVector(o,l*Math.sin(u))})})}function _u(i){let[t,e]=Ps(i);return{from:t,to:e,radius:Math.max(...i.bands.map(([,,n])=>n))}}var um=({place:i,direction:t,across:e,outlines:n})=>({inverse:$t(i,t,e).invert(),outline:n[0]});function XS(i,t,e){let n=!1;for(let s=0,r=i.length-2;s<i.length;r=s,s+=2){let[o,a,l,c]=[i[r],i[r+1],i[s],i[s+1]];a>e!=c>e&&t<o+(e-a)/(c-a)*(l-o)&&(n=!n)}return n}var Zl=class{constructor(t){this.wheels=t.wheels.map(e=>{let n={at:G(e.centre),direction:e.direction,radius:li(e),inner:e.kind==="ring"?e.radius:0};return{...n,isWorm:e.kind==="worm",points:hm(n)}}),this.walls=t.parts.filter(({kind:e})=>e==="wall").map(_u),this.points=this.wheels.flatMap(({points:e})=>e),this.swept=t.wheels.flatMap((e,n)=>ja(t,e).map(s=>hm({...s,inner:this.wheels[n].inner})))}isCovering({from:t,to:e,radius:n},s){let r=new kn(s.clone()),o=s.clone(),a=l=>(r.direction.copy(l).sub(s).normalize(),r.distanceSqToSegment(t,e,o)<n*n&&o.distanceToSquared(s)<l.distanceToSquared(s));return this.swept.some(l=>l.filter(a).length>WS*l.length)}hidden({inverse:t,outline:e},n){let s=n.clone().applyMatrix4(t),r=n.clone(),o=a=>{r.copy(a).applyMatrix4(t);let l=s.z/(s.z-r.z);return l>0&&l<1&&XS(e,s.x+l*(r.x-s.x),s.y+l*(r.y-s.y))};return this.points.filter(o).length/this.points.length}seen(t){let[e,n]=[t.clone(),t.clone()],s=(o,a)=>this.wheels.some(l=>l!==a&&$S(l,t,e.copy(o).sub(t),n)),r=this.wheels.map(o=>{let a=t.clone().sub(o.at),l=a.dot(G(o.direction))/a.length(),c=o.isWorm?Math.sqrt(1-l*l):Math.abs(l),h=o.points.filter(u=>!s(u,o)&&!this.walls.some(d=>qS(d,t,u))).length/o.points.length;return Math.sqrt(c*h)});return r.reduce((o,a)=>o+a,0)/r.length}};function qS({from:i,to:t,radius:e},n,s){let r=t.clone().sub(i),o=r.length();r.divideScalar(o);let a=p=>[p.dot(r),p.clone().addScaledVector(r,-p.dot(r))],[[l,c],[h,u]]=[n.clone().sub(i),s.clone().sub(n)].map(a),[d,f,m]=[u.dot(u),u.dot(c),c.dot(c)-e*e],x=Math.sqrt(f*f-d*m);return[(-f-x)/d,(-f+x)/d].some(p=>p>0&&p<1&&l+p*h>0&&l+p*h<o)}function $S({at:i,direction:t,radius:e,inner:n},s,r,o){let a=G(t),l=a.dot(o.copy(i).sub(s))/a.dot(r);if(!(l>0&&l<1-1e-6))return!1;let c=o.copy(s).addScaledVector(r,l).distanceTo(i);return n<c&&c<e}var YS={plate:Tt.plate,frame:Tt.plate,carrier:Tt.plate,dial:Tt.plate,pillar:Tt.plate,post:Tt.plate,foot:Tt.plate,pipe:Tt.pipe,barrel:Tt.pipe,weight:Tt.pipe,bob:Tt.plate,pin:Tt.pin,belt:Tt.mark,cord:Tt.mark,wheel:$n[0],pulley:$n[1],star:$n[2],cross:$n[2],rack:$n[3],pinion:$n[0],drum:Tt.pipe,nut:$n[4],guide:Tt.slot,road:Tt.arm,nave:Tt.arm,figure:Tt.bezel},ZS=["figure"],JS=.5,dm="wall",yu=84,KS=["post","pin"],fm=.06,xu="drum",jS=["frame","carrier","dial",xu],vu=({kind:i})=>YS[i]??Tt.arbor;function pm(i,t){return gm(i,i.parts,t)}var mm=(i,t)=>gm(i,i.shapes,t);function gm(i,t,e){return t.map(n=>{let{body:s,kind:r,place:o,direction:a,across:l}=n,c=n.outlines.length>0,h=he(a,e.toArray()),u=jS.includes(r)?G(a):null,d=c?bu(n):ZS.includes(r)?tw(n.bands):Mu(KS.includes(r)?QS(n.bands):n.bands,r===dm||r===xu?yu:40),f=r===xu?Ps(n)[0].lerp(Ps(n)[1],.5):h&&!c?null:G(o);return{body:s,kind:r,cover:u,colour:vu(n),gloss:c?JS:.8,shape:d,matrix:$t(o,a,l),at:f,plate:c,pane:r==="frame"?um(n):null,bar:r==="pillar"?_u(n):null,wall:r===dm?Ps(n):null,opened:om(i,n)}})}function QS(i){let[[t,,e],[,n,s]]=[i[0],i.at(-1)];return i.map(([r,o,a,l])=>[r===t?r-fm*e:r,o===n?o+fm*s:o,a,l])}function Mu(i,t){let e=new zt,n=[];return i.forEach((s,r)=>{if(n.push(s),r+1<i.length&&i[r+1][0]-s[1]<1e-6)return;let o=n.flatMap(([l,c,h])=>[[h,l],[h,c]]),a=n.toReversed().flatMap(([l,c,,h])=>[[h,c],[h,l]]);te(e,ew([...o,...a]),Math.max(14,Math.min(t,Math.round(10*Math.max(...n.map(([,,l])=>l)))))),n=[]}),e}function tw(i){let t=i.map(([e,n,s])=>[s,(e+n)/2]);return te(new zt,[[0,i[0][0]],[i[0][2],i[0][0]],...t,[0,i.at(-1)[1]]],32)}function ew(i){let t=i.map(([,s])=>s),[e,n]=[Math.min(...t),Math.max(...t)];return i.flatMap(([s,r],o)=>{let a=i.at(o-1),l=i[(o+1)%i.length],c=Math.min(.15*s,.1*(n-e));return r===e&&a[1]===e&&a[0]<s-2*c&&l[1]>e?[[s-c,r],[s,r+c]]:r===n&&l[1]===n&&l[0]<s-2*c&&a[1]<n?[[s,r-c],[s-c,r]]:[[s,r]]})}function bu({outlines:i,height:t},e=0){let n=new zt,s=i.map(a=>{let l=[];for(let c=0;c<a.length;c+=2)l.push(new It(a[c],a[c+1]));return l.length>1&&l[0].distanceTo(l.at(-1))<1e-9&&l.pop(),l});s.forEach((a,l)=>{Si.isClockWise(a)===(l===0)&&a.reverse()});let r=Si.triangulateShape(s[0],s.slice(1)),o=s.flat();for(let a of[-1,1]){let l=n.corners;for(let{x:c,y:h}of o)n.corner([c,h,a*t/2],[0,0,a],[1,0,0]);for(let[c,h,u]of r)n.indices.push(l+c,l+h,l+u)}for(let a of s.slice(e))nw(n,a,t/2);return n}function nw(i,t,e){t.forEach(({x:n,y:s},r)=>{let o=t[(r+1)%t.length],[a,l]=[o.x-n,o.y-s],c=Math.hypot(a,l)||1;i.face([[n,s,-e],[o.x,o.y,-e],[o.x,o.y,e],[n,s,e]],[l/c,-a/c,0],[a/c,l/c,0])})}function Zr(i,t){let e=i.bodies[t];return i.parts.filter(({body:n,bands:s,direction:r,place:o})=>n===t&&s.length&&he(r,e.direction)&&qn(e,o)<1e-6).flatMap(({bands:n,direction:s,place:r})=>{let[o,a]=[ve(e,r),Math.sign(G(s).dot(G(e.direction)))];return n.map(([l,c,h])=>[...[o+a*l,o+a*c].sort((u,d)=>u-d),h])})}function Su(i,t){return i.flatMap(({body:e,place:n,direction:s,across:r,bands:o,outlines:a,height:l})=>{let c=$t(n,s,r),h=(a[0]??[]).flatMap((f,m,x)=>m%2?[]:[[f,x[m+1],l/2],[f,x[m+1],-l/2]]),u=o.flatMap(([f,m,x])=>[f,m].flatMap(p=>[[x,0,p],[-x,0,p],[0,x,p],[0,-x,p]])),d=o.length&&he(s,t.toArray())?null:G(n);return[...h,...u].map(f=>({point:G(f).applyMatrix4(c),body:e,at:d}))})}function Jl(i,t,e){let n=t.clone().sub(i),s=n.length();if(s<1e-9)return{shape:new zt,matrix:$t(i.toArray(),[0,0,1],[1,0,0])};let r=n.divideScalar(s).toArray();return{shape:Dn(e,0,s),matrix:$t(i.toArray(),r,In(r).toArray())}}function wu(i,t,e,n,s){let r=t.clone().sub(i),o=r.length(),a=s/2,l=bn(new zt,cl(o,...n,.62*Math.min(...n)),-a,a),c=new zt;return te(c,xe(0,.72*n[1],-.9*s,.9*s),16),{shape:l,matrix:$t(i.toArray(),e,r.toArray()),boss:{shape:c,matrix:$t(t.toArray(),e,r.toArray())}}}function _m(i){let t=i.bodies.map(()=>[]);for(let e of i.wheels){let n=ve(i.bodies[e.body],e.centre);t[e.body].push(n-.9*e.thickness,n+.9*e.thickness)}for(let{pin:e,slot:n,pin_at:s,slot_at:r}of i.couplings)t[e].push(ve(i.bodies[e],s)),t[n].push(ve(i.bodies[n],r));for(let{body:e,place:n,height:s,direction:r,bands:o}of i.shapes){let a=o.length?[o[0][0],o.at(-1)[1]]:[-s,s];he(i.bodies[e].direction,r)&&t[e].push(...a.map(l=>ve(i.bodies[e],G(n).addScaledVector(G(r),l))))}for(let{body:e,dial:n}of i.pointers)n!==null&&!i.dials[n].plate&&i.dials[n].look!=="ball"&&t[e].push(ve(i.bodies[e],i.dials[n].centre));return i.bodies.forEach((e,n)=>Zr(i,n).forEach(([s,r])=>t[n].push(s,r))),t.map(e=>e.length?[Math.min(...e),Math.max(...e)]:null)}function xm(i,t,e){let n=i.bodies.map(()=>.012*e),s=new Set;return i.bodies.forEach((r,o)=>{if(s.has(o))return;let a=i.bodies.map((h,u)=>u).filter(h=>Ka(i,o,h,e)),l=h=>t[h]?t[h][1]-t[h][0]:0;a.sort((h,u)=>l(u)-l(h));let c=Math.min(...i.wheels.filter(h=>a.includes(h.body)&&h.kind!=="ring").map(h=>.55*h.root),.012*e);a.forEach((h,u)=>{s.add(h),n[h]=c*(1+.7*u/Math.max(4,a.length))})}),n}function ym(i,t,e,n){let s=[],r=iw(i.wheels.map(({thickness:o})=>o))||.01*n;return i.bodies.forEach((o,a)=>{if(o.parent===null||!t[a])return;let[l,c]=t[a],h=i.bodies[o.parent],u=h.parent!==null,d=he(h.direction,o.direction),[f,m]=[l,c];if(u&&d&&qn(h,o.point)>1e-6*n){let x=sw(i,o.parent,o,t[a],r);[f,m]=[Math.min(l,x),Math.max(c,x)];let p=Me(o,x),g=Me(h,ve(h,p)),S=wu(g,p,o.direction,[2.6*e[o.parent],2.1*e[a]],.6*r);s.push({body:o.parent,colour:Tt.arm,...S,at:p,plate:!0},{body:o.parent,colour:Tt.arm,...S.boss,at:p,plate:!0}),t[o.parent]??=[ve(h,p),ve(h,p)]}else if(u&&!d){let x=ve(o,tp(o.point,o.direction,h.point,h.direction)),p=Jl(Me(o,x),Me(o,(l+c)/2),.8*e[a]);s.push({body:o.parent,colour:Tt.arm,...p,at:null,plate:!0})}s.push({body:a,colour:Tt.arbor,...Jl(Me(o,f),Me(o,m),e[a]),at:null})}),s}var iw=i=>[...i].sort((t,e)=>t-e)[i.length>>1];function sw(i,t,e,[n,s],r){let a=i.wheels.filter(h=>h.body===t&&h.kind!=="ring").map(h=>ve(e,h.centre)),l=(n+s)/2;return a.sort((h,u)=>Math.abs(h-l)-Math.abs(u-l))[0]??n-.4*r}var Kl=class{constructor(t,e,n,s){let{body:r,centre:o,direction:a}=n.wheel;Object.assign(this,{machine:t,wave:e,body:r,slots:n.slots,walls:new Map(s.map(l=>[l.slot,l.bottom]))}),this.frame=$t(o,a,e.towards),this.back=this.frame.clone().invert(),this.cast=new Map}turn(t){let{machine:e,wave:n,body:s}=this;this.where=e.moves?e.angle(n.by)-e.angle(s):0;for(let r of t)r.geometry&&this.#t(r)}#t(t){this.cast.has(t)||this.cast.set(t,this.#e(t));let{position:e}=t.geometry.attributes,n=new N;for(let{first:s,straight:r,share:o}of this.cast.get(t)){for(let a=0;a<r.length;a+=3){let[l,c]=this.bent(r[a],r[a+1],o(r[a+2]));n.set(l,c,r[a+2]).applyMatrix4(this.frame).toArray(e.array,3*s+a)}e.needsUpdate=!0}}#e({parts:t,geometry:e}){return t.filter(({slot:s})=>this.slots.includes(s)||this.walls.has(s)).map(({slot:s,first:r,last:o})=>{let a=e.attributes.position.array.slice(3*r,3*o),l=new N;for(let h=0;h<a.length;h+=3)l.fromArray(a,h).applyMatrix4(this.back).toArray(a,h);let c=this.walls.has(s)?this.walls.get(s).clone().applyMatrix4(this.back).z:null;return{first:r,straight:a,share:h=>c===null?1:Math.max(0,1-h/c)}})}bent(t,e,n=1){let{middle:s,lobes:r}=this.wave,o=n*this.wave.rise,a=Math.atan2(e,t),l=Math.hypot(t,e)-s,[c,h]=[Math.cos(r*(a-this.where)),Math.sin(r*(a-this.where))],u=-o/r*h,d=a+u/s,f=d+(r*o*h+u)/s,m=s+o*c;return[m*Math.cos(d)+l*Math.cos(f),m*Math.sin(d)+l*Math.sin(f)]}};var Hs=class{constructor(){this.jobs=[]}add(t,e,{body:n,slot:s,lift:r,count:o=1}){rw(t),t.corners&&this.jobs.push({shape:t,matrix:e,body:n,slot:s,lift:r,count:o})}cast([t,e,n],s){let r=d=>this.jobs.reduce((f,m)=>f+m.count*d(m.shape),0),o=r(d=>d.corners),a={position:new ye(new Float32Array(3*o),3),normal:new ye(new Int8Array(4*o),4,!0),grain:new ye(new Int8Array(4*o),4,!0),place:new ye(new Uint16Array(2*o),2),lift:new ye(new Float32Array(o),1)},l=new Uint32Array(r(d=>d.indices.length));this.parts=[];let[c,h]=[0,0];for(let d of this.jobs){let[f,m]=[h,c];for(let x=0;x<d.count;x+=1){ow(a,d,x,c);for(let p of d.shape.indices)l[h++]=c+p;c+=d.shape.corners}this.parts.push({body:d.body,slot:d.slot,from:f,to:h,first:m,last:c,ball:aw(a.position.array,m,c)})}this.slots=[...new Set(this.jobs.map(({slot:d})=>d))],this.jobs=[];let u=new Ye;for(let[d,f]of Object.entries(a))u.setAttribute(d,f);return u.setIndex(new ye(l,1)),this.geometry=u,this.meshes=[t,e,n].map(d=>Object.assign(new tn(u,d),{frustumCulled:!1,matrixAutoUpdate:!1})),this.canOpen=s,this.meshes}only(t){let{attributes:e,index:n}=this.geometry,s=new Ye;for(let[l,c]of Object.entries(e))s.setAttribute(l,c);let r=this.parts.filter(({slot:l})=>this.canOpen(l)===t),o=new Uint32Array(r.reduce((l,c)=>l+c.to-c.from,0)),a=0;for(let l of r)o.set(n.array.subarray(l.from,l.to),a),a+=l.to-l.from;return s.setIndex(new ye(o,1))}open(t){t&&(this.halves??=[!1,!0].map(e=>this.only(e))),this.meshes[0].geometry=t?this.halves[0]:this.geometry,t&&(this.meshes[2].geometry=this.halves[1]),this.meshes[2].visible=t}*met(t,e){if(!this.geometry)return;let{position:n,lift:s}=this.geometry.attributes,r=this.geometry.index.array,[o,a]=[[new N,new N,new N],new N],l=new un;for(let c of this.parts){let h=t(c.body),u=e(s.array[r[c.from]]);if(l.copy(c.ball).radius+=u.length()+1e-9,!!h.intersectsSphere(l))for(let d=c.from;d<c.to;d+=3)o.forEach((f,m)=>f.fromBufferAttribute(n,r[d+m]).add(e(s.array[r[d+m]]))),h.intersectTriangle(...o,!1,a)&&(yield[a.distanceTo(h.origin),c])}}dispose(){for(let t of[this.geometry,...this.halves??[]])t?.dispose()}};function rw({points:i,normals:t,indices:e}){for(let n=0;n<e.length;n+=3){let[s,r,o]=[3*e[n],3*e[n+1],3*e[n+2]],a=0;for(let l=0;l<3;l+=1){let[c,h]=[(l+1)%3,(l+2)%3];a+=(t[s+l]+t[r+l]+t[o+l])*((i[r+c]-i[s+c])*(i[o+h]-i[s+h])-(i[r+h]-i[s+h])*(i[o+c]-i[s+c]))}a<0&&([e[n+1],e[n+2]]=[e[n+2],e[n+1]])}}function ow({position:i,normal:t,grain:e,place:n,lift:s},{shape:r,matrix:o,body:a,slot:l,lift:c,count:h},u,d){let f=u?o.clone().multiply(new Qt().makeRotationZ(2*Math.PI*u/h)):o;Eu(i.array,3*d,3,f.elements,1,1,r.points),Eu(t.array,4*d,4,f.elements,0,127,r.normals),Eu(e.array,4*d,4,f.elements,0,127,r.grains);let m=d+r.corners;for(let x=d;x<m;x+=1)n.array[2*x]=a,n.array[2*x+1]=l;if(typeof c=="number")s.array.fill(c,d,m);else for(let x=d;x<m;x+=1)s.array[x]=c(new N().fromBufferAttribute(i,x))}function Eu(i,t,e,n,s,r,o){for(let a=0;a<o.length;a+=3,t+=e){let[l,c,h]=[o[a],o[a+1],o[a+2]];i[t]=r*(n[0]*l+n[4]*c+n[8]*h+s*n[12]),i[t+1]=r*(n[1]*l+n[5]*c+n[9]*h+s*n[13]),i[t+2]=r*(n[2]*l+n[6]*c+n[10]*h+s*n[14])}}function aw(i,t,e){let n=[1/0,1/0,1/0],s=[-1/0,-1/0,-1/0];for(let o=3*t;o<3*e;o+=1)n[o%3]=Math.min(n[o%3],i[o]),s[o%3]=Math.max(s[o%3],i[o]);let r=new N(...n).add(new N(...s)).multiplyScalar(.5);return new un(r,r.distanceTo(new N(...s)))}var lw=.012,cw=.32,hw=.34,uw=`
precision highp float;
uniform mat4 projectionMatrix, modelViewMatrix;
uniform vec2 middle, half_wide;
uniform float soft, low;
in vec3 position;
out vec2 off;
void main() {
  off = position.xy * (half_wide + soft); // to the right, and to the reader
  gl_Position = projectionMatrix * modelViewMatrix * vec4(middle.x + off.x, low, middle.y + off.y, 1.0);
}`,dw=`
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
}`,jl=class{constructor(t,e){let n=r=>({value:r});this.uniforms={middle:n([0,0]),half_wide:n([1,1]),soft:n(cw*t),low:n(0),dark:n(hw)};let s={glslVersion:ai,vertexShader:uw,fragmentShader:dw,uniforms:this.uniforms,transparent:!0,depthWrite:!1};this.mesh=new tn(new dr(1.05,48),new Vn({...s,side:1})),this.mesh.matrixAutoUpdate=this.mesh.frustumCulled=!1,this.mesh.matrix.copy($t([0,0,0],G([1,0,0]).cross(G(e)).toArray(),[1,0,0])),this.back=this.mesh.matrix.clone().invert(),this.mesh.renderOrder=-1,this.size=t}fit(t){let e=t.map(c=>c.clone().applyMatrix4(this.back)),n=c=>e.reduce(([h,u],d)=>[Math.min(h,d[c]),Math.max(u,d[c])],[1/0,-1/0]),[[s,r],[o],[a,l]]=["x","y","z"].map(n);Number.isFinite(o)&&(this.uniforms.middle.value=[(s+r)/2,(a+l)/2],this.uniforms.half_wide.value=[(r-s)/2,(l-a)/2],this.uniforms.low.value=o-lw*this.size)}dispose(){this.mesh.geometry.dispose(),this.mesh.material.dispose()}};function Mm(i,t,e){let[n,s]=[i.bodies[t.pin],i.bodies[t.slot]],[r,o]=[G(t.pin_at),G(t.slot_at)],a=Math.max(.005*e,Math.min(.012*e,.12*t.pin_radius)),l=4*a;if(t.hole)return fw(t,n,s,l);let c=Dn(a,-l/2,l/2,16),h=$t(t.pin_at,n.direction,In(n.direction).toArray()),u=[{body:t.pin,colour:Tt.pin,shape:c,matrix:h,at:r},{body:t.slot,colour:Tt.slot,...pw(t,s,o,r,a),at:o}],d=Me(n,ve(n,r));if(d.distanceTo(r)>1e-6*e){let f=G(n.direction).multiplyScalar(-l/2),{shape:m,matrix:x}=wu(d.add(f),r.clone().add(f),n.direction,[1.8*a,1.6*a],.5*a);u.push({body:t.pin,colour:Tt.slot,shape:m,matrix:x,at:r})}return u}function fw(i,t,e,n){let s=Dn(i.pin_diameter/2,-n,n,24),r=i.hole/2,o=te(new zt,xe(r,1.12*r+.1,-.6*n,.6*n),48),a=c=>In(c.direction).toArray(),l=(c,h,u,d)=>f=>({body:c,colour:u,shape:d,matrix:$t(f,h.direction,a(h)),at:G(f)});return[...i.holes_at.map(l(i.slot,e,Tt.slot,o)),...i.pins_at.map(l(i.pin,t,Tt.pin,s))]}function pw(i,t,e,n,s){let{pin_radius:r,offset:o}=i,[a,l]=[Math.max(0,Math.abs(r-o)-2*s),r+o+2*s],c=new zt,h=s/2,u=(f,m,x,p)=>bn(c,[[f,p/2],[m,p/2]],-h,h,([g,S,w])=>[g,S+x,w]);for(let f of[1,-1])u(a,l,f*1.35*s,.6*s);u(l,l+.7*s,0,3.3*s),a>0&&u(0,a,0,3.3*s),te(c,xe(0,2.4*s,-h,h),24);let d=n.clone().sub(e).toArray();return{shape:c,matrix:$t(e.toArray(),t.direction,d,i.slot_turn??0)}}function bm(i,t,e,n,s,r){let o=i.bodies[t],a=Me(o,e),l=$t(a.toArray(),o.direction,In(o.direction).toArray()),c=(p,g)=>l.clone().multiply(new Qt().makeTranslation(p,0,g)),h=.013*r,u=.045*r*n,d=bn(new zt,cl(s,.022*r,.018*r,.013*r),-h/2,h/2),f=te(new zt,[[0,-u],[.011*r,-u],[.019*r,.5*u],[.016*r,u],[0,u]],24),m=[{colour:Tt.arbor,shape:d,matrix:l},{colour:Tt.arbor,shape:Dn(.016*r,-h,h),matrix:l},{colour:Nh,shape:f,matrix:c(s,u)},{colour:Nh,shape:ll(.0165*r),matrix:c(s,2*u)}].map(p=>({body:t,at:a,...p})),x=G([s,0,u]).applyMatrix4(l);return{body:t,at:a,end:Me(o,e+2*u),knob:x,touch:.06*r,reach:s,parts:m}}var Tu={gloss:.5,colour:Tt.slot};function Sm(i,t,e,n,s){let{direction:r,parent:o}=i.bodies[t],a=Me(i.bodies[t],e),l=$t(a.toArray(),G(r).multiplyScalar(n).toArray(),In(r).toArray()),[c,h,u]=i.drive==="motor"?mw(o,.075*s):i.fusee.length?_w(i.fusee):gw(.09*s),d=c.map(f=>({body:t,at:a,matrix:l,...f}));return{body:t,at:a,end:a.clone().addScaledVector(G(r),n*u),knob:a,touch:.6*h,reach:h,parts:d}}function mw(i,t){let[e,n]=[.5*t,2.5*t],s=Array.from({length:11},(a,l)=>[l%2?.9:1,e+.2*t+l/10*(n-e-.4*t)]).flatMap(([a,l],c,h)=>[[(c?h[c-1][0]:a)*t,l],[a*t,l]]),r=te(new zt,[[0,e],[.8*t,e],...s,[.8*t,n],[0,n]],48),o=bn(new zt,[[.8*t,.4*t],[1.25*t,.4*t]],1.1*t,1.9*t);return[[{...Tu,shape:Dn(.4*t,0,.35*t,32)},{colour:Tt.arbor,shape:Dn(.15*t,-.1*t,e)},{...Tu,body:i,shape:r},{...Tu,colour:Tt.pin,body:i,shape:o}],1.25*t,n]}function gw(i){let t=.5*i,e=te(te(new zt,xe(.93*i,i,0,t),64),xe(0,i,0,.08*t),64),[n,s]=[new zt,6],r=o=>[(.2+.7*o/(48*s))*i,2*Math.PI*o/48];for(let o=0;o<48*s;o+=1){let[[a,l],[c,h]]=[r(o),r(o+1)],u=(x,p,g)=>[x*Math.cos(p),x*Math.sin(p),g],[d,f]=[0,.035*i].map(x=>[[a+x,l],[c+x,h]]),m=.92*t;n.face([...d,...f.toReversed()].map(([x,p])=>u(x,p,m)),[0,0,1],[-Math.sin(l),Math.cos(l),0]);for(let[x,p]of[[d,-1],[f,1]]){let[[g,S],[w,b]]=x;n.face([u(g,S,0),u(w,b,0),u(w,b,m),u(g,S,m)],[p*Math.cos(l),p*Math.sin(l),0],[-Math.sin(l),Math.cos(l),0])}}return[[{colour:Tt.pipe,shape:e},{colour:Tt.arbor,shape:n},{colour:Tt.arbor,shape:Dn(.2*i,0,1.2*t)}],i,1.2*t]}function _w(i){let[t,e]=[Math.max(...i),1.4*Math.max(...i)/i.length],n=i.flatMap((o,a)=>[[o+.2*e,a*e],[o-.3*e,(a+.5)*e]]),s=i.length*e,r=te(new zt,[[0,0],...n,[i.at(-1),s],[0,s]],64);return[[{colour:Tt.pipe,shape:r},{colour:Tt.pipe,shape:Dn(1.1*t,-.8*e,0,64)}],1.1*t,s]}var vm=.02;function wm({kind:i,length:t,down:e,parts:n},s){let r=t-s;if(i!=="pendulum"||r<=0)return n;let o=([a,l,...c])=>[[a,s*(.6-vm),...c],[s*(.6+vm),l-r,...c]];return n.map(a=>he(a.direction,e)?{...a,bands:a.bands.flatMap(o)}:{...a,place:G(a.place).addScaledVector(G(e),-r).toArray()})}function Em({point:i,direction:t,down:e,length:n,wide:s,parts:r}){let o=G(i);return r.length?r.map(a=>({colour:vu(a),shape:Mu(a.bands,yu),matrix:$t(a.place,a.direction,a.across),at:o})):[{colour:Tt.pin,shape:Dn(s,0,n),matrix:$t(i,e,t),at:o}]}var Jr=256,xw=`
precision highp float;
precision highp int;
uniform mat4 viewMatrix, projectionMatrix;
uniform sampler2D poses, palette;
uniform vec3 axis, middle;
uniform float share;
uniform bool ghosts; // whether what is half seen is drawn now, or what is seen
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
vec4 pose(int at) { return texelFetch(poses, ivec2(at % ${Jr}, at / ${Jr}), 0); }
void main() {
  int slot = 2 * int(place.y + 0.5);
  ivec2 at = ivec2(slot % 256, slot / 256);
  paint = texelFetch(palette, at, 0);
  if (paint.a < 0.004 || (paint.a < 0.99) != ghosts) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  vec2 kind = texelFetch(palette, at + ivec2(1, 0), 0).rg;
  gloss = kind.r;
  int body = 4 * int(place.x + 0.5);
  mat4 model = mat4(pose(body), pose(body + 1), pose(body + 2), pose(body + 3));
  mat4 stands = viewMatrix * model;
  vec4 place_now = vec4(position + axis * (share * lift), 1.0);
  vec4 eye = stands * place_now;
#ifdef CUT
  vec3 off = (model * place_now).xyz - edge;
  quarter = vec3(dot(off, right), dot(off, up), kind.g);
  vec3 from = -(transpose(mat3(viewMatrix)) * viewMatrix[3].xyz) - edge;
  reader = vec2(dot(from, right), dot(from, up));
#endif
  seen = eye.xyz;
  facing = mat3(stands) * normal;
  brushed = mat3(stands) * grain;
  deep = eye.z - (viewMatrix * vec4(middle, 1.0)).z;
  gl_Position = projectionMatrix * eye;
}`,yw=`
precision highp float;
uniform float size;
in vec3 facing, brushed, seen;
in vec4 paint;
in float gloss, deep;
#ifdef CUT
in vec3 quarter;
flat in vec2 reader;
uniform vec3 section;
// whether the way from the reader to a point leads through the quarter
bool through(vec2 a, vec2 b) {
  vec2 at = a / (a - b); // where it goes in or out, as a part of the way
  vec2 low = mix(vec2(0.0), at, lessThanEqual(a, vec2(0.0))), high = mix(vec2(1.0), at, lessThanEqual(b, vec2(0.0)));
  return all(greaterThan(max(a, b), vec2(0.0))) && max(low.x, low.y) < min(high.x, high.y);
}
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
  // one who looks into a body sees its inside where it is cut: as much of the picture as the face of the cut has
  bool inside = quarter.z > 0.5 && paint.a > 0.99 && dot(n, v) < -0.1 && through(reader, quarter.xy);
  if (quarter.z > 0.5 && quarter.x > 0.0 && quarter.y > 0.0) discard;
  if (inside) { colour = vec4(sqrt(section * clamp(1.0 + 0.62 * deep / size, 0.62, 1.1)), paint.a); return; }
#endif
  if (dot(n, v) < 0.0) n = -n;
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
}`;function Tm(i,t,e,n,s){let r=Math.max(1,Math.ceil(4*i/Jr)),o=new bi(new Float32Array(4*Jr*r),Jr,r,Ke,pn);o.minFilter=o.magFilter=_e;let a={poses:{value:o},palette:{value:null},axis:{value:t},middle:{value:e},share:{value:0},size:{value:n},...s&&{edge:{value:s.at},right:{value:s.right},up:{value:s.up},section:{value:new Ut(rp)}}},l=(c,h,u={})=>{let d={...a,ghosts:{value:c}},f={defines:u,glslVersion:ai,vertexShader:xw,fragmentShader:yw,side:h};return new Vn({...f,uniforms:d,transparent:c,depthWrite:!c})};return[l(!1,Gn),l(!0,fn),l(!1,fn,{CUT:""})]}function Am([,i],t){t!=="CUT"in i.defines&&(i.defines=t?{CUT:""}:{},i.needsUpdate=!0)}var Au=256,Ql=class{constructor(){this.looks=[]}slot(t,e,n=!1){return this.looks.push({colour:new Ut(t),gloss:e,opened:n,opacity:1,shown:!0}),this.dispose(),this.looks.length-1}paint(t,e){Object.assign(this.looks[t],e),this.stale=!0}hasGhosts(t){return t.some(e=>this.looks[e].shown&&this.looks[e].opacity<1)}refresh(){let t=Math.max(1,Math.ceil(2*this.looks.length/Au));if(!this.texture)this.texture=new bi(new Uint8Array(4*Au*t),Au,t,Ke,Je),this.texture.minFilter=this.texture.magFilter=_e;else if(!this.stale)return this.texture;let{data:e}=this.texture.image;return this.looks.forEach(({colour:n,gloss:s,opened:r,opacity:o,shown:a},l)=>{let[c,h,u]=[n.r,n.g,n.b].map(d=>255*Math.sqrt(d));e.set([c,h,u,a?255*o:0,255*s,255*r],8*l)}),this.texture.needsUpdate=!0,this.stale=!1,this.texture}dispose(){this.texture?.dispose(),this.texture=void 0}};var vw=`
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
}`,Mw=`
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
}`,tc=class{constructor(t,e,n){Object.assign(this,{poses:e,run:n}),this.places=t.run.contacts.map(({body:r,at:o})=>({body:r,at:G(o),lift:e.lift(r,G(o))}));let s=this.places.length;this.geometry=new Ye,this.geometry.setAttribute("position",new ye(new Float32Array(3*s),3)),this.geometry.setAttribute("look",new ye(new Float32Array(2*s),2)),this.material=new Vn({glslVersion:ai,vertexShader:vw,fragmentShader:Mw,uniforms:{unit:{value:64},apart:{value:new Ut(en[0]).convertLinearToSRGB()}},transparent:!0,depthTest:!1,depthWrite:!1}),this.points=Object.assign(new lr(this.geometry,this.material),{frustumCulled:!1,renderOrder:9,matrixAutoUpdate:!1})}set(t){let{position:e,look:n}=this.geometry.attributes;this.places.forEach(({body:s,at:r,lift:o},a)=>{let l=this.poses.apart(r,o).applyMatrix4(this.poses.nodes[s].matrixWorld);e.setXYZ(a,l.x,l.y,l.z),n.setXY(a,this.run.flash(a,t),this.run.state(a,t)==="a"?1:0)}),e.needsUpdate=n.needsUpdate=!0}scale(t){let e=Math.min(1,Math.max(.5,Math.sqrt(12/this.places.length)));this.material.uniforms.unit.value=e*Math.min(160,Math.max(48,.14*t))}dispose(){this.geometry.dispose(),this.material.dispose()}};var bw=(i,t)=>Math.round(Math.min(84,Math.max(18,125*Math.sqrt(i/t))));function Ru(i,t,e){let[n,s]=[i-Math.max(1.3*e,.09*i),Math.max(1.9*t,.09*i)];return n<2.1*s?{rim:.9*t,boss:0}:{rim:n,boss:s}}function Rm(i,t,{rim:e,boss:n}){let[s,r]=[new zt,t/2];if(!n)return s;te(s,xe(0,n,-1.15*r,1.15*r),18);let o=e<5*n?4:e<9*n?5:6,a=Math.max(.42*n,.03*i);for(let l=0;l<o;l+=1)Sw(s,2*Math.PI*l/o,.9*n,1.005*e,a,.78*r);return s}function Sw(i,t,e,n,s,r){let[o,a]=[Math.cos(t),Math.sin(t)],c=[[0,1.75],[.07,1.25],[.18,1],[.8,.72],[.93,.95],[1,1.5]].map(([h,u])=>[e+h*(n-e),u*s]);bn(i,c,-r,r,([h,u,d])=>[h*o-u*a,h*a+u*o,d])}function Cm(i,t,e,n){let s=e/2;return te(new zt,[[i,-s],[t,-s],[t,s],[i,s]],bw(t,n))}function Cu(i,t,e,n,s){let[r,o]=[0,1].map(c=>i(t,0,c)),a=Math.min(r[2]*e,o[2]*e)-.35*n,l=.5*s;return te(new zt,[[l,e*a],[r[0],e*a],[r[0],r[2]],[o[0],o[2]],[l,o[2]]],72)}function Pm(i,t,e){let[n,s,r]=[new zt,.16*t,t/2];return te(n,xe(0,i,-r,s-r),48),te(n,xe(0,i,r-s,r),48),te(n,xe(0,e,-r,r),24)}function Im(i,t,e){let n=Math.abs(t)/Math.max(1,i.teeth),s=i.radius-.5*n,r=te(new zt,xe(0,Math.max(s,.3*i.radius),-e/2,e/2),32);for(let o=0;o<i.teeth;o+=1)ww(r,i.radius,n,t,e,2*Math.PI*o/i.teeth);return r}function ww(i,t,e,n,s,r){let o=[[-.55,-.36],[.32,-.13],[.32,.13],[-.55,.36]],a=Math.ceil(s/Math.abs(n)*32)+4,l=Math.sqrt(.87**2+.23**2);[[.23/l,-.87/l],[1,0],[.23/l,.87/l]].forEach(([h,u],d)=>{let f=i.corners;for(let m=0;m<=a;m+=1){let x=s*(m/a-.5),p=r+2*Math.PI*x/n,[g,S]=[Math.cos(p),Math.sin(p)],w=Math.min(1,(s/2-Math.abs(x))/(.7*e));for(let[b,R]of[o[d],o[d+1]]){let A=t+(w*(b+.55)-.55)*e;i.corner([A*g,A*S,Math.max(-s/2,Math.min(s/2,x+R*e))],[h*g,h*S,u],[-S,g,0])}}for(let m=0;m<a;m+=1)i.indices.push(...[0,1,2,1,3,2].map(x=>f+2*m+x))})}var Pu=2*Math.PI,Lm=.02,Ew=72,Om=.02;function Um(i,t){let{radius:e,thickness:n,cone:s,helix:r,teeth:o}=i;if(!s){let f=n*Math.tan(r)/e;return(m,x,p)=>{let g=x+(p-.5)*f;return[m*e*Math.cos(g),m*e*Math.sin(g),(p-.5)*n]}}let a=s>Math.PI/2-1e-6,l=a?0:t*e/Math.tan(s),c=e/Math.sin(s),h=Math.PI/o,u=Math.sqrt(n/e),d=1-Math.min(.45,n/c);return(f,m,x)=>{let p=(f-1)*e,g=x?d:1,S=h-Math.abs(m)+u-Math.sin(u)+(1-g)*u/2,w=a?Math.sign(m)*Math.max(0,h-S/g):m,b=(e+p*Math.cos(s))*g,R=l+(t*p*Math.sin(s)-l)*g;return[b*Math.cos(w),b*Math.sin(w),R]}}function Fm(i,t,e,n=Om,{hand:s=1,walled:r=null}={}){let a=t>Math.max(...i.map(([p])=>p))?-1:1,l=zm(i,n,a),c=a*s,h=km(new zt,l,e,c),u=Du(l[0][1],l.at(-1)[1]),d=r&&r*Math.hypot(...Tw(e(1,0,1),e(1,0,0)))/Math.hypot(...e(1,0,.5)),f=[...u.map(p=>[t-d,p]).reverse(),...l],m=Si.triangulateShape(f.map(([p,g])=>new It(p*Math.cos(g),p*Math.sin(g))),[]);for(let p of[0,1]){let g=h.corners,S=Iu([f[u.length-1],f[0],f.at(-1),f[u.length]].map(([w,b])=>e(w,b,p)),p?-c:c);for(let[w,b]of f)h.corner(e(w,b,p),S,Dm(b));for(let[w,b,R]of m)h.indices.push(g+w,g+b,g+R)}if(r===null)return h;let x=d?[[t-d,0],[t,r],[t,1-r],[t-d,1]]:[[t,0],[t,1]];for(let p=1;p<x.length;p+=1)for(let g=1;g<u.length;g+=1){let[S,[w,b]]=[[u[g-1],u[g]],[x[p-1],x[p]]],R=[...S.map(A=>e(w[0],A,w[1])),...S.toReversed().map(A=>e(b[0],A,b[1]))];h.face(R,Iu(R,-c),[...S,...S.toReversed()].map(Dm))}return h}function Du(i,t){let e=Math.max(1,Math.ceil(Ew*(t-i)/Pu-1e-6));return Array.from({length:e+1},(n,s)=>i+s/e*(t-i))}var Dm=i=>[-Math.sin(i),Math.cos(i),0],Tw=(i,t)=>i.map((e,n)=>e-t[n]);function Bm(i,t){let e=(r,o,a)=>t(r,o,a?1+Lm:-Lm),n=zm([...i,i[0]]),s=km(new zt,n,e);for(let r of[0,1])s.face(n.slice(1).map(([o,a])=>e(o,a,r)),[0,0,r?1:-1],[1,0,0]);return s}function km(i,t,e,n=1){let s=t.slice(1).map(([o,a],l)=>{let[c,h]=t[l],u=[e(c,h,0),e(o,a,0),e(o,a,1),e(c,h,1)];return{corners:u,normal:Iu(u,n)}}),r=(o,a)=>a&&Aw(o,a)>.87?ec([0,1,2].map(l=>o[l]+a[l])):o;return s.forEach(({corners:o,normal:a},l)=>{let[c,h]=[r(a,s[l-1]?.normal),r(a,s[l+1]?.normal)],u=i.corners,d=ec([0,1,2].map(f=>o[3][f]-o[0][f]));o.forEach((f,m)=>i.corner(f,m===0||m===3?c:h,d)),i.indices.push(u,u+1,u+2,u,u+2,u+3)}),i}var Aw=(i,t)=>i[0]*t[0]+i[1]*t[1]+i[2]*t[2],ec=i=>{let t=Math.hypot(...i)||1;return i.map(e=>e/t)};function Iu([i,t,e,n],s=1){let[r,o]=[[0,1,2].map(a=>e[a]-i[a]),[0,1,2].map(a=>n[a]-t[a])];return ec([r[1]*o[2]-r[2]*o[1],r[2]*o[0]-r[0]*o[2],r[0]*o[1]-r[1]*o[0]].map(a=>s*a))}function zm(i,t=Om,e=1){let n=i.map(([h])=>h),s=t*(Math.max(...n)-Math.min(...n)),r=i.map(([h,u])=>[h*Math.cos(u),h*Math.sin(u)]),o=Lu(r,s).map(([h,u])=>Rw(r,h,u,e)),a=(h,u)=>({from:h,to:h,way:[Math.cos(u),Math.sin(u)],in:[0,0]}),l=[a(r[0],i[0][1]),...o,a(r.at(-1),i.at(-1)[1])],c=i[0][1];return l.slice(1).flatMap((h,u)=>Cw(l[u],h,s).map(([d,f])=>{let m=Math.atan2(f,d);return c=m+Pu*Math.round((c-m)/Pu),[Math.hypot(d,f),c]}))}function Lu(i,t,e=0,n=i.length-1){let[s,r]=[t,-1];for(let o=e+1;o<n;o+=1){let a=Pw(i[o],i[e],i[n]);a>s&&([s,r]=[a,o])}return r<0?[[e,n]]:[...Lu(i,t,e,r),...Lu(i,t,r,n)]}function Rw(i,t,e,n){let[s,r]=[i[t],i[e]],o=ec([r[0]-s[0],r[1]-s[1]]),a=[-n*o[1],n*o[0]],l=h=>(h[0]-s[0])*a[0]+(h[1]-s[1])*a[1],c=Math.max(0,...i.slice(t+1,e).map(l));return{from:s,to:r,way:o,in:a.map(h=>h*c)}}function Cw(i,t,e){let[n,s]=[i.to,t.from].map((a,l)=>Nm(a,[i,t][l].in)),r=i.way[0]*t.way[1]-i.way[1]*t.way[0],o=((s[0]-n[0])*t.way[1]-(s[1]-n[1])*t.way[0])/r;return Math.abs(o)<=4*e?[Nm(n,i.way.map(a=>a*o))]:Math.hypot(s[0]-n[0],s[1]-n[1])>1e-9?[n,s]:[n]}var Nm=(i,t)=>i.map((e,n)=>e+t[n]);function Pw([i,t],[e,n],[s,r]){let[o,a]=[s-e,r-n],l=Math.hypot(o,a);return l<1e-12?Math.hypot(i-e,t-n):Math.abs(o*(t-n)-a*(i-e))/l}var Iw=2e3,Lw=12e3,Dw=5e-4,Nw=.75,Ow=.1,nc=class{constructor(t,e,n,s,r){let o=t.wheels[e];Object.assign(this,{scene:t,index:e,wheel:o,size:s,palette:r}),this.at=G(o.centre),this.matrix=$t(o.centre,o.direction,o.reference,o.turn),[this.own,this.toothed,this.smooth]=[0,1,2].map(()=>r.slot("#ffffff",Nw,o.kind==="ring")),this.profile=t.profiles[o.profile],this.apex=-o.facing||1,this.surface=Um(Uw(t,e),this.apex);let a=this.profile.points.map(([c])=>c),l=o.kind==="ring";this.wave=t.waves.find(c=>c.wheel===e),this.root=l?Math.max(...a):Math.min(...a),this.crest=Math.max(...a),this.depth=(Math.max(...a)-Math.min(...a))*o.radius,this.hub=Math.min(n,.4*Math.abs(this.root)*o.radius)}get slots(){return[this.own,this.toothed,this.smooth]}get seat(){let{wheel:t,root:e,hub:n,depth:s,wave:r}=this,o=e*t.radius;return t.kind==="ring"?Dr(t):r?o-r.wall:t.holes.length?(1-Math.min(.03,.1*e))*o:Ru(o,n,s).rim}castBody(t){let{wheel:e,root:n,hub:s,size:r,depth:o,seat:a}=this,{kind:l,radius:c,thickness:h,cone:u,holes:d}=e;if(l==="worm")return t(this.worm(),this.matrix,this.own);if(this.profile.hole)return t(Pm(this.crest*1.08*c,h,s),this.matrix,this.own);if(u)return t(Cu(this.surface,n-.01,this.apex,h,s),this.matrix,this.toothed),t(Cu(this.surface,1,this.apex,h,s),this.matrix,this.smooth);d.length?t(bu({outlines:[this.edge(),...d],height:h},1),this.matrix,this.own):l!=="ring"&&!this.wave&&t(Rm(n*c,h,Ru(n*c,s,o)),this.matrix,this.own),t(Cm(Math.min(a,c),Math.max(a,c),.96*h,r),this.matrix,this.smooth)}castTeeth(t,e){let{wheel:n,profile:s,surface:r,root:o,apex:a,seat:l}=this;if(n.kind==="worm")return;let c=e>Lw?.3:Math.min(.3,Math.max(.02,Dw*this.size/this.depth)),h=n.cone?o-Math.min(.03,.1*o):l/n.radius,u=n.cone||n.holes.length?null:n.kind==="ring"?Ow:0,d=s.hole?Bm(s.points,r):Fm(s.points,h,r,c,{hand:n.cone?a:1,walled:u});t(d,this.matrix,s.hole?this.own:this.toothed,Math.min(n.teeth,Iw))}edge(){let t=Math.PI/this.wheel.teeth;return Array.from({length:this.wheel.teeth},(n,s)=>Du((2*s-1)*t,(2*s+1)*t).slice(1)).flat().flatMap(n=>[this.seat*Math.cos(n),this.seat*Math.sin(n)])}worm(){let{lead:t,length:e}=Gm(this.scene,this.index);return Im(this.wheel,t,e)}paint(t){for(let e of this.slots)this.palette.paint(e,t)}show(t,e){this.palette.paint(this.own,{shown:t}),this.palette.paint(this.toothed,{shown:t&&e}),this.palette.paint(this.smooth,{shown:t&&!e})}},Vm=(i,t)=>i.pairs.filter(({wheels:e})=>e.includes(t)).map(({wheels:[e,n]})=>e===t?n:e);function Uw(i,t){let e=Vm(i,t).find(n=>i.wheels[n].kind==="worm");return e===void 0?i.wheels[t]:{...i.wheels[t],helix:Math.atan(Gm(i,e).lead/(2*Math.PI*i.wheels[e].radius))}}function Gm(i,t){let e=i.wheels[t],n=Vm(i,t).map(h=>i.wheels[h])[0];if(!n)return{lead:e.radius,length:e.thickness};let s=e.teeth*2*Math.PI*n.radius/n.teeth,[r,o]=[e,n].map(({body:h})=>Math.sign(Number.parseFloat(i.bodies[h].speed??"0"))*i.bodies[h].sense),a=G(e.centre).sub(G(n.centre));return{lead:(G(n.direction).cross(a).dot(G(e.direction))*o*r>0?-1:1)*s,length:Math.max(e.thickness,Math.min(3*Math.abs(s),n.radius))}}var Hm=.12,Fw=1.1,Kr=class{constructor(t){this.scene=t.scene;let e=Yi(this.scene);this.main=nl(this.scene),this.corners=Su([...this.scene.parts,...this.scene.shapes],this.main);let n=this.corners.map(({point:s})=>s);this.ball=Qa(this.scene,e,n),this.size=2*this.ball.radius,this.poses=new Os(t,this.main,this.ball.center,el(this.scene,[...e.flatMap(Ln),...n],this.main)),this.root=this.poses.root,this.nodes=this.poses.nodes,this.palette=new Ql,this.quarter=am(this.scene,this.size),this.materials=Tm(this.nodes.length,this.main,this.ball.center,this.size,this.quarter),this.uniforms=this.materials[0].uniforms,this.castings=[new Hs,new Hs,new Hs],this.parts=[],this.build(),this.bends=this.scene.waves.map(s=>this.bendOf(t,s)),this.sight=new Zl(this.scene),this.looks=new Is(this.scene,this.palette,this.wheels,this.parts,this.sight),this.looks.showTeeth(!1),this.looks.paint("plain"),this.root.add(...this.cast(0),...this.cast(2)),this.machine=t,this.ground=new jl(this.size,this.scene.up),this.root.add(this.ground.mesh),t.simulated&&(this.sparks=new tc(t.scene,this.poses,t.run),this.root.add(this.sparks.points)),this.explode(0)}build(){let{scene:t,size:e,palette:n}=this,s=_m(t),r=xm(t,s,e),o=pm(t,this.main),a=t.bodies.map((h,u)=>Zr(t,u)),l=h=>{let u=ve(t.bodies[h.body],h.centre),d=a[h.body].find(([f,m])=>f<=u&&u<=m);return d?d[2]:r[h.body]};this.wheels=t.wheels.map((h,u)=>new nc(t,u,l(h),e,n));for(let h of this.wheels)h.castBody(this.adder(this.castings[0],h));for(let h of o.length?o:ym(t,s,r,e))this.put(h);for(let h of mm(t,this.main))this.put(h);let c=new Set(t.parts.map(({name:h})=>h));for(let h of t.couplings)!c.has(`${h.id} pin`)&&!c.has(`${h.id} pin 1`)&&Mm(t,h,e).forEach(u=>this.put(u));t.dials.forEach((h,u)=>dp(t,u).forEach(d=>this.put(d))),t.pointers.forEach(({dial:h},u)=>{if(h===null||Fr(t,u)!==u)return;let d=t.dials[h].look==="ball"?this.poses.ball(h):t.pointers[u].body;pp(t,u,Ls(t,u)).forEach(f=>this.put({...f,body:f.slides===void 0?d:this.poses.slide(u)}))}),t.hangers.forEach((h,u)=>{let d=this.poses.hanger(u),f=wm(h,Fw*e);Em({...h,parts:f}).forEach(m=>this.put({...m,body:d})),this.corners.push(...Su(f,this.main).map(m=>({...m,body:d})))}),this.crank=this.buildCrank(s),this.crank?.parts.forEach(h=>this.put(h))}bendOf(t,e){let n=this.wheels[e.wheel],{body:s,thickness:r}=n.wheel,o=c=>c.distanceTo(n.at),l=this.parts.filter(({wall:c})=>c&&qn(this.scene.bodies[s],c[0])<1e-6*this.size).map(({slot:c,wall:h})=>({slot:c,ends:h.toSorted((u,d)=>o(u)-o(d))})).filter(({ends:[c]})=>o(c)<r);return new Kl(t,e,n,l.map(({slot:c,ends:h})=>({slot:c,bottom:h[1]})))}get isDriven(){let{crank:t,drive:e,hangers:n,shapes:s}=this.scene;return e==="weight"&&n.some(({kind:r})=>r==="weight")||s.some(({kind:r,body:o})=>r==="road"&&o===t)}buildCrank(t){let{scene:e,size:n}=this;if(e.crank===null||e.bodies[e.crank].parent===null||this.isDriven)return null;let s=e.bodies[e.crank],o=e.bodies.map((A,_)=>_).filter(A=>t[A]&&Ka(e,e.crank,A,n)).flatMap(A=>t[A].map(_=>ve(s,Me(e.bodies[A],_)))),a=t[e.crank]??[0,0],[l,c]=[Math.min(...o,...a),Math.max(...o,...a)],h=[a[0]-l,c-a[1]],u=A=>Me(s,A).distanceTo(this.ball.center),d=Math.abs(h[0]-h[1])>1e-6*n?h[0]-h[1]:he(s.direction,this.main.toArray())?G(s.direction).dot(this.main)*e.front:u(c)-u(l),f=({centre:A,normal:_,radius:E})=>he(s.direction,_)&&qn(s,A)<1.08*E+Hm*n,m=new Set(e.dials.filter(f).map(({normal:A})=>Math.sign(G(A).dot(G(s.direction))))),x=m.size===1?-[...m][0]:d<0?-1:1,p=x>0?c:l,g=p+x*.02*n,S=a[x>0?1:0],w=Zr(e,e.crank).sort((A,_)=>x*(_[0]-A[0]))[0],b=e.drive==="motor"||e.drive==="spring"?Sm(e,e.crank,g,x,n):bm(e,e.crank,g,x,Hm*n,n);b.at=Me(s,p);for(let A of b.parts)A.at=b.at;let R=(A,_,E)=>({body:e.crank,colour:Tt.arbor,...Jl(Me(s,A),Me(s,_),w?w[2]:.009*n),at:E});return b.parts.push(R(S-x*.01*n,p,null),R(p-x*.005*n,g,b.at)),b}put({colour:t,gloss:e=.85,shape:n,matrix:s,body:r,at:o,dial:a,plate:l,cover:c,pane:h,bar:u,wall:d,opened:f}){let m=this.palette.slot(t,e,f);this.castings[c||u?2:0].add(n,s,{body:r,slot:m,lift:this.poses.lift(r,o)}),this.parts.push({slot:m,body:r,at:o,dial:a,plate:l,cover:c,pane:h,bar:u,wall:d,colour:t})}adder(t,{wheel:{body:e},at:n}){return(s,r,o,a)=>t.add(s,r,{body:e,slot:o,count:a,lift:this.poses.lift(e,n)})}cast(t){return this.castings[t].cast(this.materials,e=>this.palette.looks[e].opened)}castTeeth(){let t=this.scene.wheels.reduce((e,{teeth:n})=>e+n,0);for(let e of this.wheels)e.castTeeth(this.adder(this.castings[1],e),t);this.root.add(...this.cast(1)),this.bend(),this.cut=!0}turn(){let{value:t}=this.uniforms.poses;this.poses.turn(t.image.data),t.needsUpdate=!0,this.bend(),this.sparks?.set(this.machine.time())}bend(){for(let t of this.bends)t.turn(this.castings)}cutOpen(t){this.opened=t&&!!this.quarter,Am(this.materials,this.opened)}explode(t){this.uniforms.share.value=t,this.poses.explode(t),this.turn(),this.ground.fit(this.outline())}outline(){let{crank:t,poses:e}=this,n=t?Ln({at:t.end,direction:this.scene.bodies[t.body].direction,radius:1.17*t.reach}):[],s=(a,l,c)=>{let h=e.lift(l,c);return e.apart(a,typeof h=="number"?h:h(a)).add(e.shifts[l])},r=a=>e.bodies[a].hangs!==void 0,o=this.corners.map(({point:a,body:l,at:c})=>r(l)?this.placed(a,l,c??a):s(a,l,c));return[...tl(this.scene,e),...n.map(a=>s(a,t.body,t.at)),...o]}ofCrank(t){return this.placed(t,this.crank.body,this.crank.at)}placed(t,e,n=t){return this.poses.apart(t,this.poses.lift(e,n)).applyMatrix4(this.nodes[e].matrixWorld)}pick(t){let e=this.nodes.map(()=>null),n=h=>e[h]??=t.clone().applyMatrix4(this.nodes[h].matrixWorld.clone().invert()),s=h=>this.main.clone().multiplyScalar(this.poses.share*h),r=new Set(this.looks.glass?.map(h=>h.slot)),o=(h,u)=>this.opened&&this.palette.looks[h].opened&&lm(this.quarter,t.at(u,G([0,0,0]))),[a,l]=[1/0,null];for(let h of this.castings)for(let[u,d]of h.met(n,s))u<a&&this.palette.looks[d.slot].shown&&!r.has(d.slot)&&!o(d.slot,u)&&([a,l]=[u,d.slot]);let c=this.wheels.findIndex(h=>h.slots.includes(l));return c<0?null:c}glaze(t){this.looks.glaze(t,this.ball.center)}refresh(){this.uniforms.palette.value=this.palette.refresh();for(let t of this.castings)t.meshes&&(t.meshes[1].visible=this.palette.hasGhosts(t.slots),t.open(!!this.opened))}dispose(){for(let t of this.castings)t.dispose();this.sparks?.dispose(),this.ground.dispose(),this.palette.dispose(),this.uniforms.poses.value.dispose();for(let t of this.materials)t.dispose()}};var Ou=Math.PI/180,Wm=26,Nu={front:[0,0,1],back:[0,0,-1],side:[1,0,0],free:[.36,.3,.88]},Bw=[17,38,58,4].flatMap(i=>[25,-25,0,55,-55].map(t=>[i*Ou,t*Ou])).map(([i,t])=>[Math.sin(t)*Math.cos(i),Math.sin(i),Math.cos(t)*Math.cos(i)]),kw=1.13,zw=.95,ic=[.62,.46,.64],Vw=[ic[0],ic[1],-ic[2]],Gw=1.05,Hw=1.7,Ww=.02,Xw=1200,qw=.55,sc=class{constructor(t,e,n={}){this.canvas=t,this.machine=e,this.onPick=()=>{},this.onCrank=()=>{},this.onOrbit=()=>{},this.onDraw=()=>{},this.frameMilliseconds=0,this.renderer=new Ya({canvas:t,antialias:!0,alpha:!1,stencil:!1}),this.renderer.debug.checkShaderErrors=!1,this.world=new Kr(e),this.world.cutOpen(n.cutaway??!!this.world.quarter?.hides),this.toothed=n.teeth!==!1,this.setting=new rr,this.setting.matrixAutoUpdate=!1,this.setting.add(this.world.root),this.camera=new Xe(Wm,1,.02*this.world.size,60*this.world.size),this.camera.up.set(...e.scene.up),this.controls=new $l(this.camera,t),this.controls.minDistance=.1*this.world.size,this.controls.maxDistance=30*this.world.size,this.controls.addEventListener("change",()=>this.request()),this.controls.addEventListener("start",()=>this.orbiting=!0),this.controls.addEventListener("change",()=>this.orbited()),this.controls.addEventListener("end",()=>this.orbiting=!1),this.hands=new Yl(this),this.theme({background:n.background??"#f4f1ea"}),this.observer=new ResizeObserver(()=>this.resize()),this.observer.observe(t),this.look("free"),this.resize()}setTurns(t){this.machine.turns=nt.of(t),this.turned=!0,this.request()}paint(t,e){this.change(()=>this.world.looks.paint(t,e))}highlight(t,e){this.change(()=>this.world.looks.highlight(t,e))}select(t){this.change(()=>this.world.looks.select(t))}explode(t){let e=this.framed();if(this.change(()=>this.world.explode(Math.min(1,Math.max(0,t)))),!this.width)return;if(this.from==="free"){this.look("free");return}let n=this.framed(e.towards),{position:s}=this.camera,r=s.clone().sub(this.controls.target).multiplyScalar(n.distance/e.distance);this.controls.target.add(n.target).sub(e.target),s.copy(this.controls.target).add(r),this.controls.update()}hideFront(t){let{main:e}=this.world,n=e.clone().multiplyScalar(this.machine.scene.front*Math.sign(e.z||1));this.change(()=>this.world.looks.hideBefore(t?n:null))}showTeeth(t){this.toothed=t,t&&this.whole&&!this.world.cut&&this.world.castTeeth(),this.change(()=>this.world.looks.showTeeth(t&&!!this.world.cut))}get canOpen(){return!!this.world.quarter}cutOpen(t){this.change(()=>this.world.cutOpen(t)),this.from==="free"&&this.look("free")}cut(){this.disposed||(this.whole=!0,this.showTeeth(this.toothed))}theme({background:t}){this.change(()=>this.renderer.setClearColor(new Ut(t)))}change(t){t(),this.request()}rebuild(t){if(this.disposed)return;let{opened:e,poses:{share:n}}=this.world,{chosen:s,selected:r}=this.world.looks;this.setting.remove(this.world.root),this.world.dispose(),this.machine=t,this.world=new Kr(t),this.setting.add(this.world.root),this.world.explode(n),this.world.cutOpen(e),this.showTeeth(this.toothed),Object.assign(this.world.looks,{chosen:s,selected:r}),this.turned=!0,this.request()}visit(t,e,n){let{points:s,towards:r=null,chosen:o=null}=t?Kp(this.world,t):{points:this.world.outline()};this.highlight(o,e);let a=r??this.nearer(s),{target:l,distance:c}=gu(s,a,...this.slopes),h=this.framed(a).distance;this.from=null,this.onOrbit(),this.fly(l,l.clone().addScaledVector(a,t?Math.min(Hw*c,h):h),n?0:Xw)}nearer(t){let{main:e,ball:n,size:s}=this.world,r=this.opening().clone(),o=t.reduce((l,c)=>l+c.clone().sub(n.center).dot(e),0)/t.length,a=r.dot(e);return o*a<-Ww*s?r.addScaledVector(e,-2*a):r}fly(t,e,n){let{camera:s,controls:r}=this,[o,a,l,c]=[r.target.clone(),s.position.clone(),performance.now(),this.flight={}],h=u=>{if(this.flight!==c||this.disposed||this.orbiting)return;let d=n?Math.min(1,Math.max(0,u-l)/n):1,f=d*d*(3-2*d);r.target.lerpVectors(o,t,f),s.position.lerpVectors(a,e,f),r.update(),this.request(),d<1&&requestAnimationFrame(h)};h(l)}look(t){let e=t in Nu&&t!=="free";this.from=t,e?this.fit(this.towards(Nu[t])):this.fit(this.aside(this.opening()))}towards([t,e,n]){let{front:s=1,up:r}=this.machine.scene;return r[2]&&(t||e)?G([t*s,-n,e*s]).normalize():G([t*s,e,n*s]).normalize()}opening(){let{aspect:t}=this.camera,{opened:e}=this.world,[n,s]=e?[[Vw],ic]:[Bw,Nu.free];return(this.found?.aspect!==t||this.found.opened!==e)&&(this.found={aspect:t,opened:e,towards:this.bestOf(n.map(r=>this.towards(r)),this.towards(s))}),this.found.towards}bestOf(t,e){if(this.machine.scene.dials.length)return e;let n=o=>{let{target:a,distance:l}=this.framed(o);return this.world.sight.seen(a.addScaledVector(o,l))},s=t.map(o=>({towards:o,share:n(o)})),r=Math.max(...s.map(({share:o})=>o));return r>kw*n(e)?s.find(({share:o})=>o>zw*r).towards:e}aside(t){let{main:e,poses:n}=this.world,s=t.dot(e),r=Math.min(Math.abs(s),qw),o=Math.sign(s)*(Math.abs(s)+n.share*(r-Math.abs(s)));return t.clone().addScaledVector(e,-s).normalize().multiplyScalar(Math.sqrt(1-o*o)).addScaledVector(e,o)}fit(t){this.flight=null;let{target:e,distance:n}=this.framed(t);this.controls.target.copy(e),this.camera.position.copy(e).addScaledVector(t,n),this.controls.update(),this.request()}framed(t=this.camera.position.clone().sub(this.controls.target).normalize()){return{towards:t,...gu(this.world.outline(),t,...this.slopes)}}get slopes(){let t=Math.tan(Wm*Ou/2)/Gw;return[this.machine.scene.up,t*this.camera.aspect,t]}orbited(){!this.orbiting||this.from===null||(this.from=null,this.onOrbit())}resize(){let{clientWidth:t,clientHeight:e}=this.canvas;if(!t||!e||this.disposed)return;let n=Math.min(globalThis.devicePixelRatio||1,2);this.width===t&&this.height===e&&this.density===n||(Object.assign(this,{width:t,height:e,density:n}),this.renderer.setPixelRatio(n),this.renderer.setSize(t,e,!1),this.world.sparks?.scale(n*Math.min(t,e)),this.camera.aspect=t/e,this.camera.updateProjectionMatrix(),this.from!==null&&this.look(this.from),this.render())}request(){this.waiting||this.disposed||(this.waiting=requestAnimationFrame(()=>this.render()))}render(){if(cancelAnimationFrame(this.waiting),this.waiting=0,!this.width||this.disposed)return;let t=performance.now();this.turned&&this.world.turn(),this.turned=!1,this.world.glaze(this.camera.position),this.world.refresh(),this.renderer.render(this.setting,this.camera),this.onDraw();let e=performance.now()-t;this.frameMilliseconds=this.drawn?.9*this.frameMilliseconds+.1*e:e,this.drawn=!0}leadOf(t){let{bodies:e,crank:n}=this.machine.scene,s=e[n],r=e[s.parent],o=l=>l.sense*Number(nt.of(l.speed??"0")),a=o(s)-o(r);return a?t/(2*Math.PI*a):0}dispose(){this.disposed=!0,cancelAnimationFrame(this.waiting),this.observer.disconnect(),this.hands.dispose(),this.controls.dispose(),this.world.dispose(),this.renderer.dispose(),this.renderer.forceContextLoss()}};var{scenes:$w,options:Fu}=JSON.parse(document.getElementById("scenes").textContent),ji=$w.flatMap(i=>i.run?[i,{...i,touching:!0}]:[i]),Li=ji.map(i=>new fi(i)),Ne={scenes:ji,machines:Li,options:Fu,stages:ji.map(()=>null),gears:ji.map(()=>nt.of(1)),turns:0,onTurns:null,setTurns(i){let t=nt.of(i);Ne.turns=i,Li.forEach((e,n)=>e.turns=t.times(Ne.gears[n])),Ne.stages.forEach((e,n)=>e?.setTurns(Li[n].turns)),Ne.onTurns?.(i)},open(i){try{Ne.stages[i]=new sc(document.createElement("canvas"),Li[i],Fu)}catch(t){console.warn(`3D graphics are not available: ${t.message}`),Ne.stages[i]=new dl(Li[i])}return Ne.stages[i]},close(i){Ne.stages[i]?.dispose(),Ne.stages[i]=null}};function Xm(i,t,e){let n=i.findIndex(s=>s[t]===e);if(n<0)throw new RangeError(`unknown name "${e}"`);return n}globalThis.geartrain={scenes:ji,machines:Li,stages:Ne.stages,setTurns:Ne.setTurns,get turns(){return Ne.turns},angle:(i,t)=>Li[i].angle(Xm(ji[i].bodies,"id",t)),pointer:(i,t)=>Li[i].pointer(Xm(ji[i].pointers,"output",t)),ready:!1};var Uu=()=>new Promise(i=>{requestAnimationFrame(()=>setTimeout(i)),setTimeout(i,400)});async function Yw(i){i(Ne),await Uu(),Ne.interface.openStages(),await Uu(),performance.mark("first picture");for(let t of Ne.stages)t?.cut();Ne.interface.begin?.(),globalThis.geartrain.firstPicture=performance.getEntriesByName("first picture")[0].startTime,globalThis.geartrain.ready=!0,await Uu(),performance.mark("teeth")}var qm=Yr.asked(location.hash,Fu.shown);Yw(qm?()=>Ne.interface=new Yr(Ne,qm):em);})();
/*! Bundled license information:

three/build/three.core.js:
three/build/three.module.js:
  (**
   * @license
   * Copyright 2010-2026 Three.js Authors
   * SPDX-License-Identifier: MIT
   *)
*/
