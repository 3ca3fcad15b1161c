#!/usr/bin/env python3
"""Writes the synthetic .tir files (from the two sourced ones) and the reference_*.csv; prints checks."""
import csv, os, re, sys
here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, here)
import magic_formula as mf
F = lambda n: os.path.join(here, n)
NAMES = ['Fx', 'Fy', 'Mx', 'My', 'Mz']

SYN61 = dict(PDX3=0.9, PEX3=-0.05, RBX3=5, QSX12=0.05, QSX13=0.01, QSX14=0.1, PPMX1=-0.1, PDY3=1.5, PEY5=3.0,
             PKY5=2.0, PPY5=-0.3, RBY4=8, RVY3=0.4, QSY2=0.02, QSY5=0.1, QSY6=0.05, QBZ3=-0.3, QBZ10=0.2, QDZ4=1.5,
             QDZ10=0.6, QDZ11=-0.8, QEZ3=-0.2, SSZ3=0.4, SSZ4=-0.3, PPZ2=0.4,
             LFZO=0.9, LCX=1.02, LMUX=0.85, LEX=0.95, LKX=1.1, LHX=0.8, LVX=1.2, LCY=0.98, LMUY=0.9, LEY=1.05,
             LKY=1.15, LKYC=0.9, LKZC=1.1, LHY=0.7, LVY=1.3, LTR=1.1, LRES=0.8, LXAL=1.1, LYKA=0.9, LVYKA=1.2,
             LS=1.3, LMX=0.9, LVMX=1.1, LMY=1.2, PVX1=0.01, PVX2=-0.02)
SYN52 = dict(PDX3=0.8, PEX4=0.05, PVX1=0.004, PVX2=-0.002, QSX1=-0.003, QSX2=0.6, QSX3=0.025, QSY2=0.05,
             QSY3=0.001, QSY4=2e-5, QBZ10=0.3, QEZ3=0.002, RVY4=12, RHY2=0.004, REY2=-0.05, RBY3=0.01, REX2=0.1,
             LFZO=0.6, LCX=1.02, LEX=0.95, LKX=1.1, LHX=0.8, LVX=1.2, LMUX=0.85, LGAX=1.3, LCY=0.98, LEY=1.05,
             LKY=1.15, LHY=0.7, LVY=1.3, LMUY=0.9, LGAY=0.9, LTR=1.1, LRES=0.8, LGAZ=1.2, LXAL=1.1, LYKA=0.9,
             LVYKA=1.2, LS=1.3, LMX=0.9, LMY=1.2, LVMX=1.1)


def synth(src, dst, over, note):
    text, left = open(src, encoding='utf-8').read(), set(over)
    out = []
    for line in text.split('\n'):
        m = re.match(r'([A-Z0-9_]+)(\s*=\s*)(\S+)(.*)$', line)
        if m and m.group(1) in over:
            left.discard(m.group(1))
            line = '%s%s%-17r $(synthetic)' % (m.group(1), m.group(2), over[m.group(1)])
        out.append(line)
        if line.startswith('FILE_FORMAT') and note:
            out.append('! SYNTHETIC: %s, lines marked "(synthetic)" changed. No tyre;' % os.path.basename(src))
            out.append('! made so that no coefficient and no scaling factor is without effect.')
            note = False
    assert not left, left
    open(dst, 'w', encoding='utf-8').write('\n'.join(out))


def halton(i, b):
    f, r = 1.0, 0.0
    while i:
        f /= b
        r += f * (i % b)
        i //= b
    return r


def rows(fn, pnom):
    R = []
    add = lambda fz, k=0.0, a=0.0, g=0.0, p=1.0, v=16.7: R.append(
        (round(fz * fn, 3), k, a, g, round(p * pnom, 3) if pnom else 0.0, v))
    for k in (-0.3, -0.12, -0.05, -0.02, -0.005, 0.0, 0.005, 0.02, 0.05, 0.12, 0.3):       # pure longitudinal
        add(1.0, k)
    for fz in (0.3, 0.6, 1.5, 2.0):
        for k in (-0.1, -0.01, 0.01, 0.1):
            add(fz, k)
    for a in (-0.25, -0.12, -0.06, -0.02, -0.005, 0.005, 0.02, 0.06, 0.12, 0.25):          # pure lateral
        add(1.0, 0.0, a)
    for fz in (0.3, 0.6, 1.5, 2.0):
        for a in (-0.15, -0.03, 0.03, 0.15):
            add(fz, 0.0, a)
    for g in (-0.1, -0.04, 0.04, 0.1):                                                     # camber
        for a in (-0.08, 0.0, 0.08):
            add(1.0, 0.0, a, g)
        add(0.4, 0.03, 0.02, g)
        add(1.8, -0.03, -0.02, g)
        add(1.0, 0.06, 0.0, g)
    for v in (5.0, 30.0, 50.0):                                                            # speed
        add(0.8, 0.02, 0.03, 0.02, 1.0, v)
    if pnom:
        for p in (0.8, 0.9, 1.1, 1.2):                                                     # pressure
            add(1.0, 0.04, 0.0, 0.0, p)
            add(1.3, 0.0, 0.05, 0.0, p)
            add(0.7, -0.06, 0.04, -0.05, p)
    for i in range(1, 49):                                                                 # everything
        add(0.3 + 1.7 * halton(i, 2), round(-0.3 + 0.6 * halton(i, 3), 4), round(-0.25 + 0.5 * halton(i, 5), 4),
            round(-0.1 + 0.2 * halton(i, 7), 4), round(0.8 + 0.4 * halton(i, 11), 4), round(8 + 32 * halton(i, 13), 2))
    return R


def spread(a, b):
    """largest |a-b| of each output over its largest |a|"""
    return max(max(abs(x[j] - y[j]) for x, y in zip(a, b)) / (max(abs(x[j]) for x in a) or 1.0) for j in range(5))


def run61(name):
    P = mf.read_tir(F(name + '.tir'))
    R = rows(P['FNOMIN'], P['NOMPRES'])
    det = [[mf.mf61_details(P, r[0], r[1], r[2], r[3], r[4], r[5], rd) for r in R] for rd in ('book', 'mftyre')]
    val = [[[d[n] for n in NAMES] for d in dd] for dd in det]
    with open(F('reference_%s.csv' % name), 'w', newline='') as f:
        w = csv.writer(f, lineterminator='\n')
        w.writerow(['Fz', 'kappa', 'alpha', 'gamma', 'p', 'Vx'] + NAMES + [n + '_mftyre' for n in NAMES])
        for r, a, b in zip(R, *val):
            w.writerow([repr(float(x)) for x in r] + ['%.17g' % x for x in a + b])
    with open(F('reference_%s_epsV0.1.csv' % name), 'w', newline='') as f:     # book with eps_V = eps_Vx = 0.1
        w = csv.writer(f, lineterminator='\n')
        w.writerow(['Fz', 'kappa', 'alpha', 'gamma', 'p', 'Vx'] + NAMES)
        for r in R:
            w.writerow([repr(float(x)) for x in r] + ['%.17g' % x for x in mf.mf61(P, *r, reading='book', eps_V=0.1)])
    keys = ['Fx0', 'Fy0', 'Mz0', 'Kxk', 'Kya', 'mux', 'muy', 'Gxa', 'Gyk', 'SVyk', 't', 'Mzr', 's']
    with open(F('details_%s.csv' % name), 'w', newline='') as f:
        w = csv.writer(f, lineterminator='\n')
        w.writerow(['reading', 'Fz', 'kappa', 'alpha', 'gamma', 'p', 'Vx'] + keys)
        for rd, dd in zip(('book', 'mftyre'), det):
            for r, d in zip(R, dd):
                w.writerow([rd] + [repr(float(x)) for x in r] + ['%.17g' % d[k] for k in keys])
    e0 = [list(mf.mf61(P, *r, reading='book', eps=0.0)) for r in R]
    e1 = [list(mf.mf61(P, *r, reading='book', eps_V=0.1)) for r in R]
    print('%s: %d rows; clamps %s; eps 1e-6 vs 0: %.1e; eps_V 0.1 vs 1e-6: %.1e; book vs mftyre %s'
          % (name, len(R), sorted({c for dd in det for d in dd for c in d['clamped']}), spread(val[0], e0),
             spread(val[0], e1), ['%s %.1e' % (n, max(abs(a[j] - b[j]) for a, b in zip(*val))
                                               / max(abs(a[j]) for a in val[0])) for j, n in enumerate(NAMES)]))


def run52(name):
    P = mf.read_tir(F(name + '.tir'))
    R = rows(P['FNOMIN'] * P['LFZO'], None)
    det = [mf.mf52_details(P, r[0], r[1], r[2], r[3], r[5]) for r in R]
    val = [[d[n] for n in NAMES] for d in det]
    with open(F('reference_%s.csv' % name), 'w', newline='') as f:
        w = csv.writer(f, lineterminator='\n')
        w.writerow(['Fz', 'kappa', 'alpha', 'gamma', 'Vx'] + NAMES)
        for r, a in zip(R, val):
            w.writerow([repr(float(x)) for x in r[:4] + r[5:]] + ['%.17g' % x for x in a])
    keys = ['Fx0', 'Fy0', 'Kxk', 'Kya', 'mux', 'muy', 'Gxa', 'Gyk', 'SVyk', 't', 'Mzr', 's']
    with open(F('details_%s.csv' % name), 'w', newline='') as f:
        w = csv.writer(f, lineterminator='\n')
        w.writerow(['Fz', 'kappa', 'alpha', 'gamma', 'Vx'] + keys)
        for r, d in zip(R, det):
            w.writerow([repr(float(x)) for x in r[:4] + r[5:]] + ['%.17g' % d[k] for k in keys])
    e0 = [list(mf.mf52(P, r[0], r[1], r[2], r[3], r[5], eps=0.0)) for r in R]
    print('%s: %d rows; clamps %s; eps 1e-6 vs 0: %.1e' % (name, len(R), sorted({c for d in det for c in d['clamped']}),
                                                            spread(val, e0)))


synth(F('book_205_60R15.tir'), F('synthetic_mf61_all.tir'), SYN61, True)
synth(F('hmmwv_pac2002.tir'), F('synthetic_pac2002_all.tir'), SYN52, True)
run61('book_205_60R15')
run61('synthetic_mf61_all')
run52('hmmwv_pac2002')
run52('synthetic_pac2002_all')
