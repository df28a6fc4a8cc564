/* Six lessons: a paragraph, a question that the controls answer, a scene, and how fast it is first shown. [en, de] */
const LESSONS = [
  {
    name: "haff",
    speed: 10,
    colour: "speed",
    scene: "{flow: hcs, phi: 0.1, particles: 1000, collision: {e: 0.9}}",
    title: ["Haff's law", "Haffs Gesetz"],
    text: [
      "Nobody heats this gas. Each collision takes a share 1 − e² of the energy of approach, so the gas cools, and the colder it is, the rarer it collides. Haff (1983) put the two together: T = T₀/(1 + ζt/2)². On logarithmic axes that is first flat, then a straight line of slope −2.",
      "Niemand heizt dieses Gas. Jeder Stoß nimmt den Anteil 1 − e² der Annäherungsenergie, das Gas kühlt ab, und je kälter es ist, desto seltener stößt es. Haff (1983) verband beides: T = T₀/(1 + ζt/2)². Auf logarithmischen Achsen ist das erst flach, dann eine Gerade mit Steigung −2.",
    ],
    question: [
      "At which e is T a hundred times lower after half as many collisions as at e = 0.9 (see the clock)? Does the slope at late times depend on e?",
      "Bei welchem e ist T nach halb so vielen Stößen wie bei e = 0,9 hundertmal kleiner (siehe die Uhr)? Hängt die späte Steigung von e ab?",
    ],
  },
  {
    name: "equipartition",
    speed: 3,
    colour: "spin",
    scene: "{flow: usf, phi: 0.1, particles: 1000, collision: {e: 0.9, beta: 0}}",
    title: ["Broken equipartition", "Gebrochene Gleichverteilung"],
    text: [
      "Rough grains spin. In a gas at equilibrium every degree of freedom would hold the same energy, and θ would equal T. Here shear feeds only the motion of the centres, collisions pass some of it on to the spins, and lose some of both. So θ is not T, and for most β far below it: a thermometer of spins and one of speeds disagree.",
      "Raue Körner drehen sich. Im Gleichgewicht hätte jeder Freiheitsgrad gleich viel Energie, θ wäre gleich T. Hier speist die Scherung nur die Bewegung der Mittelpunkte, Stöße geben einen Teil an die Drehungen weiter und verlieren von beidem. Darum ist θ nicht T und liegt für die meisten β weit darunter: Ein Thermometer für Drehungen zeigt anderes als eines für Geschwindigkeiten.",
    ],
    question: [
      "For which β do spins and speeds come closest to the same temperature? Try β = 1, and then −0.9.",
      "Bei welchem β kommen sich die beiden Temperaturen am nächsten? Versuche β = 1, dann −0,9.",
    ],
  },
  {
    name: "normal_stress",
    speed: 3,
    colour: "speed",
    scene: "{flow: usf, phi: 0.02, particles: 1000, collision: {e: 0.7}}",
    title: ["Normal stress differences", "Normalspannungsdifferenzen"],
    text: [
      "Water at rest or in slow shear presses equally in all directions. A dilute sheared granular gas does not: a grain that moves across the flow comes where the flow is faster, and so speeds are larger along x. P_xx is far above P_yy and P_zz, and so their differences over the pressure, N1 and N2, are not zero. Theories of first order in the shear rate, such as Lun's, say that all three are equal.",
      "Wasser drückt in Ruhe und bei langsamer Scherung in alle Richtungen gleich. Ein dünnes geschertes granulares Gas nicht: Wer quer zur Strömung fliegt, kommt dorthin, wo sie schneller ist, und so sind Geschwindigkeiten entlang x größer. P_xx liegt weit über P_yy und P_zz; ihre Differenzen durch den Druck, N1 und N2, sind nicht null. Theorien erster Ordnung in der Scherrate, wie die von Lun, sagen alle drei gleich voraus.",
    ],
    question: [
      "What makes the three stresses more alike: larger e, larger φ, or both?",
      "Was macht die drei Spannungen gleicher: größeres e, größeres φ oder beides?",
    ],
  },
  {
    name: "friction",
    speed: 3,
    colour: "spin",
    scene: "{flow: usf, phi: 0.2, particles: 1000, collision: {e: 0.9, beta: 0.5, mu: 0.2}}",
    title: ["Friction", "Reibung"],
    text: [
      "With Coulomb's law a contact slides when the grains meet at a grazing angle, and then friction is μ times the normal push; otherwise it sticks, as rough grains with that β do. Small μ: nearly smooth grains. Large μ: rough ones.",
      "Nach Coulomb gleitet ein Kontakt, wenn die Körner sich streifend treffen; dann ist die Reibung μ mal der Normalstoß. Sonst haftet er, wie bei rauen Körnern mit diesem β. Kleines μ: fast glatte Körner. Großes μ: raue.",
    ],
    question: [
      "Does T fall all the way as μ grows, or is there a μ at which friction costs most energy? And at β = 1?",
      "Fällt T mit wachsendem μ immer weiter, oder gibt es ein μ, bei dem Reibung die meiste Energie kostet? Und bei β = 1?",
    ],
  },
  {
    name: "enskog",
    speed: 10,
    colour: "since",
    scene: "{flow: usf, phi: 0.3, particles: 1000, collision: {e: 0.7}}",
    title: ["Where Enskog fails", "Wo Enskog versagt"],
    text: [
      "Enskog's equation assumes molecular chaos: two grains that meet know nothing of each other. dsmc solves just that; md has no such assumption. In the dilute gas, from φ = 0.01 down, both agree. At φ = 0.3 and e = 0.7 grains that have met stay near each other and meet again, their velocities are alike, and md parts from dsmc: look at z of the compressibility factor and of the viscosity. That of the temperature tells little there: shear heats md less, its collisions lose less, and in T the two nearly cancel.",
      "Enskogs Gleichung nimmt molekulares Chaos an: Zwei Körner, die sich treffen, wissen nichts voneinander. dsmc löst genau das; md nimmt nichts an. Im dünnen Gas, ab φ = 0,01 abwärts, stimmen beide überein. Bei φ = 0,3 und e = 0,7 bleiben Körner nach dem Stoß beieinander und treffen sich wieder, ihre Geschwindigkeiten gleichen sich, und md trennt sich von dsmc: siehe z von Kompressibilitätsfaktor (compressibility_factor) und Viskosität (shear_viscosity). Das der Temperatur sagt dort wenig: Scherung heizt md weniger, seine Stöße kosten weniger, und in T hebt sich beides fast auf.",
    ],
    question: [
      "How far must you lower φ until |z| of the compressibility factor stays below 3? What does the temperature do on the way? And how far must you raise e, at φ = 0.3, until |z| of the viscosity does?",
      "Wie weit muss φ sinken, bis |z| des Kompressibilitätsfaktors unter 3 bleibt? Was tut unterwegs die Temperatur? Und wie weit muss e bei φ = 0,3 steigen, bis |z| der Viskosität es tut?",
    ],
  },
  {
    name: "clustering",
    speed: 30,
    colour: "speed",
    scene: "{flow: hcs, phi: 0.2, particles: 2000, collision: {e: 0.6}, aspect: [3, 3, 1]}",
    title: ["Collapse and clustering", "Kollaps und Klumpen"],
    text: [
      "A cooling gas does not stay homogeneous. Inelastic grains leave a collision more parallel than they came, so neighbours begin to move together, vortices grow, and grains gather in clusters. In a dense cluster collisions follow each other ever faster: without end they would be a collapse, which the contact time prevents (it makes such collisions elastic, and the page counts them). Small boxes have no room for it.",
      "Ein abkühlendes Gas bleibt nicht homogen. Unelastische Körner verlassen einen Stoß gleichläufiger, als sie kamen; Nachbarn bewegen sich bald gemeinsam, Wirbel wachsen, Körner sammeln sich in Klumpen. Dort folgen Stöße immer schneller aufeinander: Ohne Ende wäre das ein Kollaps, den die Kontaktzeit verhindert (sie macht solche Stöße elastisch, und die Seite zählt sie). Kleine Kästen haben dafür keinen Platz.",
    ],
    question: [
      "At which e do clusters no longer come? And with which N is the box too small for them at e = 0.9?",
      "Ab welchem e bleiben die Klumpen aus? Und bei welchem N ist der Kasten bei e = 0,9 zu klein?",
    ],
  },
];
