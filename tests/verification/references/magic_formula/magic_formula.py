#!/usr/bin/env python3
"""Magic Formula tyre model, steady state: MF-Tyre 6.1 (mf61) and MF-Tyre 5.2 / PAC2002 (mf52).

Second, independent implementation; its only purpose is reference numbers for checking another one.
Standard library only. SI units and radians throughout.

SIGN CONVENTIONS  (TYDEX W axes, ISO: x forward, y to the left, z up, origin in the contact point C)
  kappa  = -Vsx/|Vcx| = (omega*Re - Vcx)/|Vcx|        positive driving, -1 locked wheel
  alpha  : tan(alpha) = Vcy/|Vcx|, Vcy the lateral velocity of C along +y (left)
           => with the coefficients of a .tir file (PKY1 < 0, PDY1 > 0) Fy is NEGATIVE for positive alpha
  gamma  : inclination angle about +x (right-hand): positive = top of the wheel towards -y (right).
           Same number as gamma of the book (its axes are turned by 180 deg about the same x axis).
  Fz > 0 : load. Fx, Fy, Mx, My, Mz act on the tyre, in the axes above, in the contact point.
  Mx     : right-hand about +x.   My: NEGATIVE while rolling forward (rolling resistance).
  Mz     : right-hand about +z (up); a self-aligning moment is POSITIVE for positive alpha
           (Fy < 0 acts a trail t > 0 behind C: Mz = -t*Fy > 0).
  p      : inflation pressure (Pa).  Vx = Vcx > 0 (m/s): enters My, cos'(alpha), LMUV.
The book's equations are in adapted SAE axes (y right, z down): Fy, My, Mz have the opposite sign there,
kappa, alpha, gamma, Fx, Mx the same one. The form of the equations is the same except for My.
Forward rolling only (Vx > 0): sgn(Vcx) appears where the equations have it, but reverse is not a purpose.

EQUATION NUMBERS (4.E..) are those of H.B. Pacejka, Tire and Vehicle Dynamics, 3rd ed. 2012, 4.3.2;
(A..) those of Besselink, Schmeitz, Pacejka, VSD 48:S1 (2010) 337-352. No turn slip: all zeta = 1.

SMALL NUMBERS. The book only says that each epsilon is small and has the sign of the main quantity next
to it (p. 177). Here all are EPS = 1e-6 in SI units: eps_x, eps_y (N), eps_K (N/rad), eps_V, eps_Vx (m/s).
At the reference points this moves no result by more than ~1e-7 relative (see README).

READINGS of mf61 (where published sources differ; README.md lists them):
  'book'    3rd edition, with its two misprints repaired (4.E40 camber term, 4.E70 first factor)
  'mftyre'  as MF-Tyre 6.1 itself (2010 paper and what MFeval found against TNO's solver):
            alpha*=alpha, gamma*=gamma, A_mu=1, signed camber in Dt, R0/Fz0 (unscaled) in t and Fz0 in s,
            arctan form of the equivalent slip angles
Other values of the dict READINGS reproduce published third-party numbers only.
"""
import math
import re

EPS = 1e-6

SCALES_61 = ('LFZO LCX LMUX LEX LKX LHX LVX LCY LMUY LEY LKY LHY LVY LTR LRES LXAL LYKA LVYKA LS '
             'LKYC LKZC LVMX LMX LMY').split()

READINGS = {
    # alpha_star 4.E3, gamma_star 4.E4, a_mu 4.E8, dt_abs 4.E43, trail_fz0/s_fz0 4.E42/4.E76,
    # eq_slip 4.E77-78, geo_camber: gamma in 4.E40, 4.E43, 4.E76; dr_cos 4.E47, fy_prime 4.E74
    'book': dict(alpha_star='tan', gamma_star='sin', a_mu=10.0, dt_abs=True, scaled_fz0=True,
                 eq_slip='sqrt', geo_camber='star', dr_cos='prime', fy_prime='gamma0', svx_v=True),
    'mftyre': dict(alpha_star='raw', gamma_star='raw', a_mu=1.0, dt_abs=False, scaled_fz0=False,
                   eq_slip='atan', geo_camber='raw', dr_cos='prime', fy_prime='gamma0', svx_v=False),
    # MFeval, useMode 221 (alpha* and gamma* on, no limit checks)
    'mfeval221': dict(alpha_star='tan', gamma_star='sin', a_mu=1.0, dt_abs=False, scaled_fz0=False,
                      eq_slip='atan', geo_camber='raw', dr_cos='of_star', fy_prime='gamma0', svx_v=False),
    # the MF 6.1.2 C++ unit test of a public program: alpha itself, F'y with camber (= Fy - SVyk)
    'mf612test': dict(alpha_star='raw', gamma_star='sin', a_mu=10.0, dt_abs=True, scaled_fz0=True,
                      eq_slip='sqrt', geo_camber='star', dr_cos='prime', fy_prime='minus_svyk', svx_v=False),
    # 2nd edition (2006): 4.E74 is F'y = Fy - SVyk. Its camber terms of mu_y and Kya differ: gamma = 0 only
    'book2006': dict(alpha_star='tan', gamma_star='sin', a_mu=10.0, dt_abs=True, scaled_fz0=True,
                     eq_slip='sqrt', geo_camber='star', dr_cos='prime', fy_prime='minus_svyk', svx_v=True),
}


def read_tir(path):
    """All `KEY = number` of a .tir file; strings (quotes stripped) too. MASS of [UNITS] is dropped."""
    out, section = {}, ''
    with open(path, encoding='utf-8') as f:
        for line in f:
            line = line.strip()
            if not line or line[0] in '!$':
                continue
            if line[0] == '[':
                section = line[1:line.index(']')].upper()
                continue
            line = re.split(r'[$!]', line, maxsplit=1)[0]
            if '=' not in line:
                continue
            key, val = (x.strip() for x in line.split('=', 1))
            if section == 'UNITS' or section == 'MDI_HEADER':
                key = section + '.' + key
            try:
                out[key.upper()] = float(val)
            except ValueError:
                out[key.upper()] = val.strip("'\" ")
    return out


def sgn(x):
    return 1.0 if x > 0 else -1.0 if x < 0 else 0.0


def guard(x, eps):
    """x + eps with eps of the sign of x (book p. 177)."""
    return x + (eps if x >= 0 else -eps)


def mf_sin(B, C, D, E, x):
    return D * math.sin(C * math.atan(B * x - E * (B * x - math.atan(B * x))))


def mf_cos(B, C, E, x):
    return math.cos(C * math.atan(B * x - E * (B * x - math.atan(B * x))))


def mf61(params, Fz, kappa, alpha, gamma, p, Vx, reading='book', eps=EPS, eps_V=None, clamp_E=True):
    """(Fx, Fy, Mx, My, Mz) by MF 6.1."""
    r = mf61_details(params, Fz, kappa, alpha, gamma, p, Vx, reading, eps, eps_V, clamp_E)
    return r['Fx'], r['Fy'], r['Mx'], r['My'], r['Mz']


def mf61_details(params, Fz, kappa, alpha, gamma, p, Vx, reading='book', eps=EPS, eps_V=None, clamp_E=True):
    o = READINGS[reading]
    c = lambda k: float(params.get(k, 0.0))                  # coefficient, default 0
    L = {k: float(params.get(k, 1.0)) for k in SCALES_61}    # scaling factor, default 1
    LMUV = float(params.get('LMUV', 0.0))
    R0, V0, Fz0, pi0 = c('UNLOADED_RADIUS'), c('LONGVL'), c('FNOMIN'), c('NOMPRES')
    if eps_V is None:
        eps_V = eps
    Vcx = float(Vx)
    clamped = []

    def le1(E, name):                                        # conditions "(<= 1)" of the book
        if E > 1.0:
            clamped.append(name)
            return 1.0 if clamp_E else E
        return E

    # ---------------------------------------------------------------- preliminaries
    Fz0p = L['LFZO'] * Fz0                                   # 4.E1
    dfz = (Fz - Fz0p) / Fz0p                                 # 4.E2a
    dpi = (p - pi0) / pi0                                    # 4.E2b
    astar = math.tan(alpha) * sgn(Vcx) if o['alpha_star'] == 'tan' else alpha      # 4.E3
    gstar = math.sin(gamma) if o['gamma_star'] == 'sin' else gamma                 # 4.E4
    gz = gstar if o['geo_camber'] == 'star' else gamma
    Vcy = math.tan(alpha) * abs(Vcx)
    Vc = math.hypot(Vcx, Vcy)
    cosp = Vcx / guard(Vc, eps_V)                            # 4.E6, 4.E6a  (cos'alpha)
    Vs = abs(Vcx) * math.hypot(kappa, math.tan(alpha))       # slip speed, 4.E5, 4.E3
    lmux = L['LMUX'] / (1 + LMUV * Vs / V0)                  # 4.E7   lambda*_mux
    lmuy = L['LMUY'] / (1 + LMUV * Vs / V0)
    A = o['a_mu']
    lmuxp = A * lmux / (1 + (A - 1) * lmux)                  # 4.E8   lambda'_mux
    lmuyp = A * lmuy / (1 + (A - 1) * lmuy)

    # ---------------------------------------------------------------- Fx, pure slip
    SHx = (c('PHX1') + c('PHX2') * dfz) * L['LHX']                                         # 4.E17
    kx = kappa + SHx                                                                       # 4.E10
    Cx = c('PCX1') * L['LCX']                                                              # 4.E11
    mux = ((c('PDX1') + c('PDX2') * dfz) * (1 + c('PPX3') * dpi + c('PPX4') * dpi ** 2)
           * (1 - c('PDX3') * gamma ** 2) * lmux)                                          # 4.E13
    Dx = mux * Fz                                                                          # 4.E12
    Ex = le1((c('PEX1') + c('PEX2') * dfz + c('PEX3') * dfz ** 2)
             * (1 - c('PEX4') * sgn(kx)) * L['LEX'], 'Ex')                                 # 4.E14
    Kxk = (Fz * (c('PKX1') + c('PKX2') * dfz) * math.exp(c('PKX3') * dfz)
           * (1 + c('PPX1') * dpi + c('PPX2') * dpi ** 2) * L['LKX'])                      # 4.E15
    Bx = Kxk / guard(Cx * Dx, eps)                                                         # 4.E16
    SVx = Fz * (c('PVX1') + c('PVX2') * dfz) * L['LVX'] * lmuxp                            # 4.E18
    if o['svx_v']:
        SVx *= abs(Vcx) / (eps_V + abs(Vcx))                                               # 4.E18 {..}
    Fx0 = mf_sin(Bx, Cx, Dx, Ex, kx) + SVx                                                 # 4.E9

    # ---------------------------------------------------------------- Fy, pure slip
    def lateral(g):
        """4.E19-4.E30 at camber g (already the starred one)."""
        q = {}
        Kya = (c('PKY1') * Fz0p * (1 + c('PPY1') * dpi) * (1 - c('PKY3') * abs(g))
               * math.sin(c('PKY4') * math.atan((Fz / Fz0p) / ((c('PKY2') + c('PKY5') * g ** 2)
                                                               * (1 + c('PPY2') * dpi)))) * L['LKY'])   # 4.E25
        SVyg = Fz * (c('PVY3') + c('PVY4') * dfz) * g * L['LKYC'] * lmuyp                  # 4.E28
        Kyg0 = Fz * (c('PKY6') + c('PKY7') * dfz) * (1 + c('PPY5') * dpi) * L['LKYC']      # 4.E30
        SHy = (c('PHY1') + c('PHY2') * dfz) * L['LHY'] + (Kyg0 * g - SVyg) / guard(Kya, eps)   # 4.E27
        SVy = Fz * (c('PVY1') + c('PVY2') * dfz) * L['LVY'] * lmuyp + SVyg                 # 4.E29
        ay = astar + SHy                                                                   # 4.E20
        Cy = c('PCY1') * L['LCY']                                                          # 4.E21
        muy = ((c('PDY1') + c('PDY2') * dfz) * (1 + c('PPY3') * dpi + c('PPY4') * dpi ** 2)
               * (1 - c('PDY3') * g ** 2) * lmuy)                                          # 4.E23
        Dy = muy * Fz                                                                      # 4.E22
        Ey = le1((c('PEY1') + c('PEY2') * dfz)
                 * (1 + c('PEY5') * g ** 2 - (c('PEY3') + c('PEY4') * g) * sgn(ay)) * L['LEY'], 'Ey')   # 4.E24
        By = Kya / guard(Cy * Dy, eps)                                                     # 4.E26
        Fy0 = mf_sin(By, Cy, Dy, Ey, ay) + SVy                                             # 4.E19
        q.update(Kya=Kya, Kyg0=Kyg0, SHy=SHy, SVy=SVy, Cy=Cy, muy=muy, By=By, Fy0=Fy0)
        return q
    y = lateral(gstar)
    y0 = lateral(0.0)                                        # gamma = 0, for 4.E32 and 4.E74

    # ---------------------------------------------------------------- combined slip
    Exa = le1(c('REX1') + c('REX2') * dfz, 'Exa')                                          # 4.E56
    Bxa = (c('RBX1') + c('RBX3') * gstar ** 2) * math.cos(math.atan(c('RBX2') * kappa)) * L['LXAL']   # 4.E54
    Cxa, SHxa = c('RCX1'), c('RHX1')                                                       # 4.E55, 4.E57
    Gxa = mf_cos(Bxa, Cxa, Exa, astar + SHxa) / mf_cos(Bxa, Cxa, Exa, SHxa)                # 4.E51-4.E53
    Fx = Gxa * Fx0                                                                         # 4.E50

    Eyk = le1(c('REY1') + c('REY2') * dfz, 'Eyk')                                          # 4.E64
    Byk = ((c('RBY1') + c('RBY4') * gstar ** 2)
           * math.cos(math.atan(c('RBY2') * (astar - c('RBY3')))) * L['LYKA'])             # 4.E62
    Cyk = c('RCY1')                                                                        # 4.E63
    SHyk = c('RHY1') + c('RHY2') * dfz                                                     # 4.E65
    DVyk = (y['muy'] * Fz * (c('RVY1') + c('RVY2') * dfz + c('RVY3') * gstar)
            * math.cos(math.atan(c('RVY4') * astar)))                                      # 4.E67
    SVyk = DVyk * math.sin(c('RVY5') * math.atan(c('RVY6') * kappa)) * L['LVYKA']          # 4.E66
    Gyk = mf_cos(Byk, Cyk, Eyk, kappa + SHyk) / mf_cos(Byk, Cyk, Eyk, SHyk)                # 4.E59-4.E61
    Fy = Gyk * y['Fy0'] + SVyk                                                             # 4.E58

    # ---------------------------------------------------------------- Mx, My
    Mx = (R0 * Fz * L['LMX'] * (
        c('QSX1') * L['LVMX'] - c('QSX2') * gamma * (1 + c('PPMX1') * dpi) + c('QSX3') * Fy / Fz0
        + c('QSX4') * math.cos(c('QSX5') * math.atan((c('QSX6') * Fz / Fz0) ** 2))
        * math.sin(c('QSX7') * gamma + c('QSX8') * math.atan(c('QSX9') * Fy / Fz0))
        + c('QSX10') * math.atan(c('QSX11') * Fz / Fz0) * gamma)                           # 4.E69
        # QSX12..14: not in the book; MF-Tyre 6.1.2 / 6.2 equation manual
        + R0 * L['LMX'] * (Fy * (c('QSX13') + c('QSX14') * abs(gamma)) - Fz * c('QSX12') * gamma * abs(gamma)))
    My = (-sgn(Vcx) * R0 * Fz0 * L['LMY'] * (
        c('QSY1') + c('QSY2') * Fx / Fz0 + c('QSY3') * abs(Vcx / V0) + c('QSY4') * (Vcx / V0) ** 4
        + (c('QSY5') + c('QSY6') * Fz / Fz0) * gamma ** 2)
        * (Fz / Fz0) ** c('QSY7') * (p / pi0) ** c('QSY8'))                  # 4.E70 / (A48): Fz0, not Fz

    # ---------------------------------------------------------------- Mz
    SHt = c('QHZ1') + c('QHZ2') * dfz + (c('QHZ3') + c('QHZ4') * dfz) * gstar              # 4.E35
    at = astar + SHt                                                                       # 4.E34
    Kyap = guard(y['Kya'], eps)                                                            # 4.E39
    SHf = y['SHy'] + y['SVy'] / Kyap                                                       # 4.E38
    ar = astar + SHf                                                                       # 4.E37
    Bt = ((c('QBZ1') + c('QBZ2') * dfz + c('QBZ3') * dfz ** 2)
          * (1 + c('QBZ4') * gz + c('QBZ5') * abs(gz) + c('QBZ6') * gz ** 2) * L['LKY'] / lmuy)   # 4.E40 / (A58)
    Ct = c('QCZ1')                                                                         # 4.E41
    Fzt = Fz0p if o['scaled_fz0'] else Fz0
    Dt0 = (Fz * (R0 / Fzt) * (c('QDZ1') + c('QDZ2') * dfz) * (1 - c('PPZ1') * dpi)
           * L['LTR'] * sgn(Vcx))                                                          # 4.E42
    Dt = Dt0 * (1 + c('QDZ3') * (abs(gz) if o['dt_abs'] else gz) + c('QDZ4') * gz ** 2)    # 4.E43 / (A60)
    Et = le1((c('QEZ1') + c('QEZ2') * dfz + c('QEZ3') * dfz ** 2)
             * (1 + (c('QEZ4') + c('QEZ5') * gstar) * (2 / math.pi) * math.atan(Bt * Ct * at)), 'Et')   # 4.E44
    Br = c('QBZ9') * L['LKY'] / lmuy + c('QBZ10') * y['By'] * y['Cy']                      # 4.E45
    Cr = 1.0                                                                               # 4.E46
    Dr = (Fz * R0 * ((c('QDZ6') + c('QDZ7') * dfz) * L['LRES']
                     + ((c('QDZ8') + c('QDZ9') * dfz) * (1 + c('PPZ2') * dpi)
                        + (c('QDZ10') + c('QDZ11') * dfz) * abs(gstar)) * gstar * L['LKZC'])
          * lmuy * sgn(Vcx) * (cosp if o['dr_cos'] == 'prime' else math.cos(astar)))       # 4.E47
    ratio2 = (Kxk / Kyap * kappa) ** 2
    if o['eq_slip'] == 'sqrt':
        ateq = math.sqrt(at ** 2 + ratio2) * sgn(at)                                       # 4.E77
        areq = math.sqrt(ar ** 2 + ratio2) * sgn(ar)                                       # 4.E78
    else:
        ateq = math.atan(math.sqrt(math.tan(at) ** 2 + ratio2)) * sgn(at)                  # (A55)
        areq = math.atan(math.sqrt(math.tan(ar) ** 2 + ratio2)) * sgn(ar)                  # (A54)
    t = Dt * mf_cos(Bt, Ct, Et, ateq) * cosp                                               # 4.E73
    Mzr = Dr * math.cos(Cr * math.atan(Br * areq))                                         # 4.E75
    Fyp = Gyk * y0['Fy0'] if o['fy_prime'] == 'gamma0' else Fy - SVyk                      # 4.E74
    Fzs = Fz0p if o['scaled_fz0'] else Fz0
    s = R0 * (c('SSZ1') + c('SSZ2') * Fy / Fzs + (c('SSZ3') + c('SSZ4') * dfz) * gz) * L['LS']   # 4.E76
    Mz = -t * Fyp + Mzr + s * Fx                                                           # 4.E71, 4.E72
    # pure side slip (4.E31-4.E33, 4.E36), for information
    t0 = Dt * mf_cos(Bt, Ct, Et, at) * cosp
    Mz0 = -t0 * y0['Fy0'] + Dr * math.cos(Cr * math.atan(Br * ar))

    return dict(Fx=Fx, Fy=Fy, Mx=Mx, My=My, Mz=Mz, Fx0=Fx0, Fy0=y['Fy0'], Mz0=Mz0, Kxk=Kxk, Kya=y['Kya'],
                mux=mux, muy=y['muy'], Gxa=Gxa, Gyk=Gyk, SVyk=SVyk, t=t, Mzr=Mzr, s=s, clamped=sorted(set(clamped)))


SCALES_52 = ('LFZO LCX LMUX LEX LKX LHX LVX LGAX LCY LMUY LEY LKY LHY LVY LGAY LTR LRES LGAZ LXAL LYKA LVYKA '
             'LS LMX LVMX LMY').split()


def mf52(params, Fz, kappa, alpha, gamma, Vx, eps=EPS, clamp_E=True, mfeval221=False, my_from_shift=False):
    """(Fx, Fy, Mx, My, Mz) by MF 5.2 / PAC2002 (2005 level: no pressure terms, camber factors LGAX/Y/Z)."""
    r = mf52_details(params, Fz, kappa, alpha, gamma, Vx, eps, clamp_E, mfeval221, my_from_shift)
    return r['Fx'], r['Fy'], r['Mx'], r['My'], r['Mz']


def mf52_details(params, Fz, kappa, alpha, gamma, Vx, eps=EPS, clamp_E=True, mfeval221=False, my_from_shift=False):
    """Equations of the MF-Tyre 5.2 / Adams PAC2002 manuals (they have no numbers).

    alpha and gamma themselves, not tan and sin. mfeval221=True only reproduces MFeval with useMode 221,
    which puts tan(alpha), sin(gamma) in, cos'alpha (4.E6) into t and cos(tan(alpha)) into Mzr.
    my_from_shift: the manuals' rule My = R0 (SVx + Kx SHx) if QSY1 = QSY2 = 0 (off: MFeval has it not).
    """
    c = lambda k: float(params.get(k, 0.0))
    L = {k: float(params.get(k, 1.0)) for k in SCALES_52}
    if float(params.get('LKG', 1.0)) != 1.0:
        raise ValueError('LKG (later PAC2002) is not part of MF 5.2')
    R0, V0, Fz0 = c('UNLOADED_RADIUS'), c('LONGVL'), c('FNOMIN')
    clamped = []

    def le1(E, name):
        if E > 1.0:
            clamped.append(name)
            return 1.0 if clamp_E else E
        return E

    Fz0p = Fz0 * L['LFZO']                                   # Fz0' = Fz0 lambda_Fz0
    dfz = (Fz - Fz0p) / Fz0p
    a = math.tan(alpha) if mfeval221 else alpha
    gs = math.sin(gamma) if mfeval221 else gamma
    gx, gy, gz = gamma * L['LGAX'], gs * L['LGAY'], gs * L['LGAZ']     # gamma_x, gamma_y, gamma_z
    gzt = gamma * L['LGAZ']                                  # (MFeval keeps the plain angle in Dt, Bt)
    # MFeval: cos'alpha of 4.E6 with eps_V, numerically cos(alpha)
    ca = Vx / (math.hypot(Vx, math.tan(alpha) * Vx) + EPS) if mfeval221 else math.cos(alpha)

    # ---- Fx, pure
    SHx = (c('PHX1') + c('PHX2') * dfz) * L['LHX']
    SVx = Fz * (c('PVX1') + c('PVX2') * dfz) * L['LVX'] * L['LMUX']
    kx = kappa + SHx
    Cx = c('PCX1') * L['LCX']
    mux = (c('PDX1') + c('PDX2') * dfz) * (1 - c('PDX3') * gx ** 2) * L['LMUX']
    Dx = mux * Fz
    Ex = le1((c('PEX1') + c('PEX2') * dfz + c('PEX3') * dfz ** 2) * (1 - c('PEX4') * sgn(kx)) * L['LEX'], 'Ex')
    Kx = Fz * (c('PKX1') + c('PKX2') * dfz) * math.exp(c('PKX3') * dfz) * L['LKX']
    Bx = Kx / guard(Cx * Dx, eps)
    Fx0 = mf_sin(Bx, Cx, Dx, Ex, kx) + SVx

    # ---- Fy, pure
    SHy = (c('PHY1') + c('PHY2') * dfz) * L['LHY'] + c('PHY3') * gy
    SVy = Fz * ((c('PVY1') + c('PVY2') * dfz) * L['LVY'] + (c('PVY3') + c('PVY4') * dfz) * gy) * L['LMUY']
    ay = a + SHy
    Cy = c('PCY1') * L['LCY']
    muy = (c('PDY1') + c('PDY2') * dfz) * (1 - c('PDY3') * gy ** 2) * L['LMUY']
    Dy = muy * Fz
    Ey = le1((c('PEY1') + c('PEY2') * dfz) * (1 - (c('PEY3') + c('PEY4') * gy) * sgn(ay)) * L['LEY'], 'Ey')
    Ky0 = (c('PKY1') * Fz0 * math.sin(2 * math.atan(Fz / (c('PKY2') * Fz0 * L['LFZO']))) * L['LFZO'] * L['LKY'])
    Ky = Ky0 * (1 - c('PKY3') * abs(gy))
    By = Ky / guard(Cy * Dy, eps)
    Fy0 = mf_sin(By, Cy, Dy, Ey, ay) + SVy

    # ---- Fx, combined
    Bxa = c('RBX1') * math.cos(math.atan(c('RBX2') * kappa)) * L['LXAL']
    Cxa, SHxa = c('RCX1'), c('RHX1')
    Exa = le1(c('REX1') + c('REX2') * dfz, 'Exa')
    Gxa = mf_cos(Bxa, Cxa, Exa, a + SHxa) / mf_cos(Bxa, Cxa, Exa, SHxa)
    Fx = Fx0 * Gxa

    # ---- Fy, combined
    Byk = c('RBY1') * math.cos(math.atan(c('RBY2') * (a - c('RBY3')))) * L['LYKA']
    Cyk = c('RCY1')
    Eyk = le1(c('REY1') + c('REY2') * dfz, 'Eyk')
    SHyk = c('RHY1') + c('RHY2') * dfz
    DVyk = muy * Fz * (c('RVY1') + c('RVY2') * dfz + c('RVY3') * gs) * math.cos(math.atan(c('RVY4') * a))
    SVyk = DVyk * math.sin(c('RVY5') * math.atan(c('RVY6') * kappa)) * L['LVYKA']
    Gyk = mf_cos(Byk, Cyk, Eyk, kappa + SHyk) / mf_cos(Byk, Cyk, Eyk, SHyk)
    Fy = Fy0 * Gyk + SVyk

    # ---- Mx, My
    Mx = R0 * Fz * (c('QSX1') * L['LVMX'] - c('QSX2') * gamma + c('QSX3') * Fy / Fz0) * L['LMX']
    if my_from_shift and c('QSY1') == 0 and c('QSY2') == 0:
        My = R0 * (SVx + Kx * SHx)
    else:
        My = -sgn(Vx) * R0 * Fz * L['LMY'] * (c('QSY1') + c('QSY2') * Fx / Fz0 + c('QSY3') * abs(Vx / V0)
                                              + c('QSY4') * (Vx / V0) ** 4)

    # ---- Mz, combined (pure at kappa = 0)
    SHt = c('QHZ1') + c('QHZ2') * dfz + (c('QHZ3') + c('QHZ4') * dfz) * gz
    at = a + SHt
    Kyp = guard(Ky, eps)
    ar = a + SHy + SVy / Kyp                                 # alpha_r = alpha + SHf, SHf = SHy + SVy/Ky
    Bt = ((c('QBZ1') + c('QBZ2') * dfz + c('QBZ3') * dfz ** 2) * (1 + c('QBZ4') * gzt + c('QBZ5') * abs(gzt))
          * L['LKY'] / L['LMUY'])
    Ct = c('QCZ1')
    Dt = (Fz * (c('QDZ1') + c('QDZ2') * dfz) * (1 + c('QDZ3') * gzt + c('QDZ4') * gzt ** 2) * (R0 / Fz0) * L['LTR'])
    Et = le1((c('QEZ1') + c('QEZ2') * dfz + c('QEZ3') * dfz ** 2)
             * (1 + (c('QEZ4') + c('QEZ5') * gz) * (2 / math.pi) * math.atan(Bt * Ct * at)), 'Et')
    Br = c('QBZ9') * L['LKY'] / L['LMUY'] + c('QBZ10') * By * Cy
    Dr = (Fz * ((c('QDZ6') + c('QDZ7') * dfz) * L['LRES'] + (c('QDZ8') + c('QDZ9') * dfz) * gz) * R0 * L['LMUY'])
    ratio2 = (Kx / Kyp * kappa) ** 2
    ateq = math.atan(math.sqrt(math.tan(at) ** 2 + ratio2)) * sgn(at)
    areq = math.atan(math.sqrt(math.tan(ar) ** 2 + ratio2)) * sgn(ar)
    t = Dt * mf_cos(Bt, Ct, Et, ateq) * ca
    Mzr = Dr * math.cos(math.atan(Br * areq)) * (math.cos(a) if mfeval221 else ca)
    s = (c('SSZ1') + c('SSZ2') * Fy / Fz0 + (c('SSZ3') + c('SSZ4') * dfz) * gamma) * R0 * L['LS']
    Mz = -t * (Fy - SVyk) + Mzr + s * Fx

    return dict(Fx=Fx, Fy=Fy, Mx=Mx, My=My, Mz=Mz, Fx0=Fx0, Fy0=Fy0, Kxk=Kx, Kya=Ky, mux=mux, muy=muy,
                Gxa=Gxa, Gyk=Gyk, SVyk=SVyk, t=t, Mzr=Mzr, s=s, clamped=sorted(set(clamped)))
