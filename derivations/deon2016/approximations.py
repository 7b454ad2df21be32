from sympy import *
from xsec_sym.exact import SigmaSphericalGaussian
from xsec_sym.proof import Source, interval
from xsec_sym.proof.accuracy import *
paper = Source("deon2016", section="2.5.1")
u, m = symbols("u m", real=True)
v, r = symbols("v r", positive=True)
kappa = 2 / m**2
S = sqrt(1 - u**2)
def beckmann_sigma(sign):
    return (u*(1+erf(u/(m*S)))+m*S*exp(sign*u**2/(m**2*(1-u**2)))/sqrt(pi))/2
U = v*r/sqrt(1+v**2*r**2)
tail_b = r*exp(-16)/(2*sqrt(pi))
bc = (U*(1+erf(v)) + r/sqrt(1+v**2*r**2)*exp(-v**2)/sqrt(pi))/2
k = 2/r**2
odd = Chart(v, r, U, r, m, (0, 4), bc + (tanh(k/2)*(U-r**2*U)+(-r**2-2)*U+U*coth(k/2))/4, even="odd parts agree")
f40 = lambda sign: (tanh(1/m**2)*(u-m**2*Abs(u))+(-m**2-2)*u+u*coth(1/m**2))/4 + beckmann_sigma(sign)
c40 = paper.accuracy("claim.40-accuracy", "x", left=SigmaSphericalGaussian(u, m), printed=f40(-1),
  where=[interval(u,-1,1), interval(m, 0, Rational(1,4), open=True)],
  accuracy=Accuracy(Rational(1,1000), odd, Rational(3,1000), Rational(1,4),
     tail=Tail(Integer(4), tail_b + 4*r*exp(-k), "t"), limit=Limit(Rational(3,1000), r/(2*sqrt(pi))*(1+exp(-2/r)), "l")))
