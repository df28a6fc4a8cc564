/* Six lessons: a paragraph, a question that the controls answer, a scene, and how fast it is first shown. [en, de] */
const LESSONS = [
  {
    name: "haff",
    speed: 10,
    colour: "speed",
    scene: "{flow: hcs, phi: 0.1, particles: 1000, collision: {e: 0.9}}",
    title: ["Haff's law", "Haffs Gesetz"],
    text: [
      "This gas is not heated. Each collision removes a share 1 − e² of the energy of approach, so the gas cools. The colder it is, the fewer collisions per time. From both Haff (1983) derived T = T₀/(1 + ζt/2)². On logarithmic axes this is first flat, then a straight line of slope −2.",
      "Dieses Gas wird nicht geheizt. Jeder Stoß entzieht den Anteil 1 − e² der Annäherungsenergie, das Gas kühlt ab. Je kälter es ist, desto seltener sind Stöße. Aus beidem folgerte Haff (1983): T = T₀/(1 + ζt/2)². Auf logarithmischen Achsen ist das erst flach, dann eine Gerade mit Steigung −2.",
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
      "Rough grains spin. At equilibrium every degree of freedom has the same mean energy, so θ = T. Here shear feeds only the motion of the centres. Collisions pass some of this energy on to the spins and lose some of both. So θ differs from T, and for most β it is far below T.",
      "Raue Körner drehen sich. Im Gleichgewicht hat jeder Freiheitsgrad im Mittel gleich viel Energie, also θ = T. Hier speist die Scherung nur die Bewegung der Mittelpunkte. Stöße geben einen Teil dieser Energie an die Drehungen weiter und verlieren von beidem. Darum ist θ nicht T und liegt für die meisten β weit darunter.",
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
      "Water at rest or in slow shear presses equally in all directions. A dilute sheared granular gas does not: a grain that moves across the flow reaches layers of another flow velocity, so its peculiar velocity grows along x. P_xx is far above P_yy and P_zz. Their differences over the pressure, N1 and N2, are not zero. In theories of first order in the shear rate, such as Lun's, all three are equal.",
      "Wasser drückt in Ruhe und bei langsamer Scherung in alle Richtungen gleich. Ein dünnes geschertes granulares Gas nicht: Ein Korn, das quer zur Strömung fliegt, erreicht Schichten anderer Strömungsgeschwindigkeit; so wächst seine Eigengeschwindigkeit entlang x. P_xx liegt weit über P_yy und P_zz. Ihre Differenzen durch den Druck, N1 und N2, sind nicht null. In Theorien erster Ordnung in der Scherrate, wie der von Lun, sind alle drei gleich.",
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
      "With Coulomb's law a contact slides if the grains collide at a grazing angle. The tangential impulse is then μ times the normal one. Otherwise the contact sticks, as for rough grains with that β. Small μ: nearly smooth grains. Large μ: rough ones.",
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
      "Enskog's equation assumes molecular chaos: velocities of two grains before their collision are uncorrelated. dsmc solves this equation; md does not assume it. In the dilute gas, from φ = 0.01 down, both agree. At φ = 0.3 and e = 0.7 grains collide again with the same neighbours, their velocities become correlated, and md differs from dsmc: see z of the compressibility factor and of the viscosity. T hardly shows it: shear heats md less, its collisions lose less, and the two nearly cancel.",
      "Enskogs Gleichung nimmt molekulares Chaos an: Die Geschwindigkeiten zweier Körner sind vor ihrem Stoß unkorreliert. dsmc löst diese Gleichung; md setzt das nicht voraus. Im dünnen Gas, ab φ = 0,01 abwärts, stimmen beide überein. Bei φ = 0,3 und e = 0,7 stoßen Körner immer wieder mit denselben Nachbarn, ihre Geschwindigkeiten werden korreliert, und md weicht von dsmc ab: siehe z von Kompressibilitätsfaktor (compressibility_factor) und Viskosität (shear_viscosity). T zeigt es kaum: Scherung heizt md weniger, seine Stöße kosten weniger, und beides hebt sich fast auf.",
    ],
    question: [
      "How far must you lower φ until |z| of the compressibility factor stays below 3? What happens to the temperature meanwhile? How far must you raise e, at φ = 0.3, until |z| of the viscosity stays below 3?",
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
      "A cooling gas does not stay homogeneous. After an inelastic collision velocities are more parallel than before. So neighbours begin to move together, vortices grow, and grains gather in clusters. In a dense cluster the time between collisions shrinks without limit: inelastic collapse. The contact time prevents it: it makes such collisions elastic, and the page counts them. Small boxes have no room for clusters.",
      "Ein abkühlendes Gas bleibt nicht homogen. Nach einem unelastischen Stoß sind die Geschwindigkeiten paralleler als vorher. So bewegen sich Nachbarn bald gemeinsam, Wirbel wachsen, Körner sammeln sich in Klumpen. Dort wird die Zeit zwischen Stößen beliebig kurz: inelastischer Kollaps. Die Kontaktzeit verhindert ihn: Sie macht solche Stöße elastisch, und die Seite zählt sie. Kleine Kästen haben für Klumpen keinen Platz.",
    ],
    question: [
      "Above which e do no clusters form? And for which N is the box too small for them at e = 0.9?",
      "Ab welchem e bleiben die Klumpen aus? Und bei welchem N ist der Kasten bei e = 0,9 zu klein?",
    ],
  },
];
